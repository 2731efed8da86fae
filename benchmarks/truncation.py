"""`python -m benchmarks.truncation`: how near to the truth is what is said of bodies cut off.

Free bodies of many kinds are truncated to 8 to 100 elastic modes and held by mounts over three decades
of stiffness at nodes, by means of several nodes, by arms, or by some of each. By how much their
frequencies then exceed those of the bodies with all their modes is compared with what is said.
"""

import argparse
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from benchmarks.free_bodies import FreeBody, free_bodies
from benchmarks.measure import ONE_THREAD
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import RESOLVED_HZ, solve_modes
from modeviz.dynamics.truncation_gap import TruncationGap, gap_if_solved
from modeviz.fem.component import body_from_matrices
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import GROUND, Spring
from modeviz.vehicle.residuals import modal_compliance
from modeviz.vehicle.vehicle import Vehicle

N_EXACT = 116
"""Modes of what counts as exact, which has residual vectors too."""

N_ELASTIC = (8, 12, 16, 25, 40, 60, 100)

STIFFNESS = (0.01, 0.1, 1.0, 10.0)
"""Of a mount beside what holds it."""

SMALL = 1e-3
"""What is above that is looked at."""


@dataclass(frozen=True)
class Case:
    """What is said of a body on mounts, and what is true."""

    kind: str
    body: str
    held: str
    """By nodes, arms, means, or some of each."""
    n_elastic: int
    gap: TruncationGap
    true: float

    @property
    def off(self) -> float:
        """How many times as much is said as is true, or as little."""
        return max(self.gap.change / self.true, self.true / self.gap.change)


def main() -> None:
    """Prints which part of what is said is how near, by kind and by how well it is said to be known."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.truncation", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="a tenth of them: shows that all works")
    parser.add_argument("--seed", type=int, default=1, help="random seed of places and bodies")
    options = parser.parse_args()
    os.environ.update(ONE_THREAD)
    found = list(cases(options.seed, 10 if options.quick else 1))
    print(f"{len(found)} cases; part of them that is said within 2 and 4 times of the truth, in %")
    print(f"{'':24}{'cases':>7}{'within 2':>10}{'within 4':>10}{'at least':>10}")
    for within in (2.0, 4.0, 10.0):
        _print(f"said within {within:g}", found, lambda c, w=within: c.gap.within == w)
    for kind in dict.fromkeys(c.kind for c in found):
        _print(kind, found, lambda c, k=kind: c.kind == k)
    for held in dict.fromkeys(c.held for c in found):
        _print(f"held by {held}", found, lambda c, h=held: c.held == h)
    for n in N_ELASTIC:
        _print(f"{n} elastic modes", found, lambda c, n=n: c.n_elastic == n)


def _print(what: str, found: list[Case], belongs: Callable[[Case], bool]) -> None:
    some = [case for case in found if belongs(case)]
    if some:
        off = np.array([case.off for case in some])
        least = np.mean([case.true >= case.gap.at_least for case in some])
        parts = [np.mean(off <= 2), np.mean(off <= 4), least]
        print(f"{what:24}{len(some):7}" + "".join(f"{100 * part:10.1f}" for part in parts))


def cases(seed: int = 1, every: int = 1) -> Iterator[Case]:
    """Yield one of so many of the cases of all bodies, chosen at random."""
    rng, choice = np.random.default_rng(seed), np.random.default_rng(seed + 1)
    for free in free_bodies(seed):
        exact = body_from_matrices(
            free.name, "other", free.name, free.matrices, free.points, N_EXACT, 0.01
        )
        for held, body in _held(exact, rng):
            for n_elastic in N_ELASTIC:
                for stiffness in _mounts(body, rng):
                    if choice.random() * every < 1:
                        yield from _case(free, held, body, n_elastic, stiffness)


def _held(body: FlexibleBody, rng: np.random.Generator) -> Iterator[tuple[str, FlexibleBody]]:
    """The body with attachments of one kind each, and with some of each."""
    of_kind = {a.name.split()[0]: [] for a in body.attachments}
    for attachment in body.attachments:
        of_kind[attachment.name.split()[0]].append(attachment)
    for kind, attachments in of_kind.items():
        yield kind, replace(body, attachments=tuple(attachments))
    some = rng.choice(len(body.attachments), 4, replace=False)
    yield "some of each", replace(body, attachments=tuple(body.attachments[i] for i in some))


def _mounts(body: FlexibleBody, rng: np.random.Generator) -> Iterator[Floats]:
    """Stiffness (n_attachments, 3): as stiff in all directions, and differently in each."""
    compliance = modal_compliance(body)
    softest = compliance.max(axis=1, keepdims=True)
    for part in STIFFNESS:
        yield np.repeat(part / softest, 3, axis=1)
    part = 10 ** rng.uniform(-2, 1, softest.shape) * 10 ** rng.uniform(-0.5, 0.5, compliance.shape)
    yield part / np.maximum(compliance, 0.01 * softest)


def _case(
    free: FreeBody, held: str, exact: FlexibleBody, n_elastic: int, stiffness: Floats
) -> Iterator[Case]:
    springs = tuple(
        Spring(a.name, "m", (exact.name, GROUND), np.tile(a.position, (2, 1)), stiffness=k)
        for a, k in zip(exact.attachments, stiffness, strict=True)
    )
    vehicle = Vehicle("v", (exact.truncated(exact.n_rigid + n_elastic),), springs)
    gap = gap_if_solved(vehicle)
    if gap is None:
        return
    found = solve_modes(assemble(vehicle), below_hz=gap.below_hz).frequency_hz
    truer = replace(vehicle, bodies=(exact,))
    lower = solve_modes(assemble(truer), n_modes=max(len(found), 1)).frequency_hz[: len(found)]
    vibrates = lower > RESOLVED_HZ
    true = float((found[vibrates] / lower[vibrates] - 1).max(initial=0.0))
    if max(true, gap.change) > SMALL:
        yield Case(free.kind, free.name, held, n_elastic, gap, max(true, 1e-12))


if __name__ == "__main__":
    main()
