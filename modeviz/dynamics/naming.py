"""Names for modes, from what moves.

Each named motion gives every mode a score from 0 to 1, the share of the motion in the mode; one
assignment, solved as a whole, hands the names out. What is left is called after the bodies that move
most and how they do.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeGuard

import numpy as np
from scipy.optimize import linear_sum_assignment

from modeviz.dynamics.assembly import System
from modeviz.dynamics.catalogue import MOTION_WORDS, Shares, named_motions
from modeviz.dynamics.energy import kinetic_energy
from modeviz.dynamics.modes import Modes
from modeviz.dynamics.motions import (
    bending_rows,
    end_rows,
    flexibility_share,
    rigid_rows,
    share_rows,
    wheel_motions,
)
from modeviz.dynamics.roles import Axle, Unit, axles, units
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body, FlexibleBody

MINIMUM_SCORE = 0.3
"""Below this a mode is not called by a named motion."""

MINIMUM_OF_ONE = 0.1
"""The same of a single body on its mounts, whose modes are to have six different names."""

WEAK_SCORE = 0.5
"""Below this most of the mode's energy is in other motions than the one it is called after."""

ALIKE = 9
"""Decimals of scores that count: axles that are alike are called the same however arithmetic rounds."""


@dataclass(frozen=True)
class ModeName:
    """The name of a mode, and how well it fits."""

    name: str
    score: float
    """Share of that motion in the mode, 0 to 1."""

    @property
    def motion(self) -> str:
        """The motion without its number: "box flexing" of "box flexing 2"."""
        return re.sub(r" \d+$", "", self.name)

    @property
    def is_weak(self) -> bool:
        """Whether the name fits weakly."""
        return self.score < WEAK_SCORE

    @property
    def spoken(self) -> str:
        """The name for people: "~cab yaw" where it fits weakly."""
        return f"~{self.name}" if self.is_weak else self.name


@dataclass(frozen=True, eq=False)
class Namer:
    """The words and rows of motions by which a vehicle's modes are named, whatever its mount rates."""

    system: System
    axles: tuple[Axle, ...]
    units: tuple[Unit, ...]
    rows: Floats
    """(n_rows, n_dofs): share rows of the whole vehicle as one body, of each axle's hop and tramp and
    of all that moves as one in the units; then `end_rows` if there are two axles, and `bending_rows`
    if there is a frame."""
    blocks: tuple[int, ...]
    """Where in `rows` each of those but the first begins."""


def prepare_names(system: System) -> Namer:
    """Prepare a vehicle once for `name_modes`."""
    its_axles, its_units = axles(system.vehicle), units(system.vehicle)
    none = np.zeros((0, system.n_dofs))
    frame = next(filter(_bends, system.vehicle.bodies), None)
    blocks = [
        rigid_rows(system, system.vehicle.bodies),
        np.vstack([none, *(share_rows(system, wheel_motions(system, a.wheels)) for a in its_axles)]),
        np.vstack([rigid_rows(system, bodies) for unit in its_units for bodies in unit.as_one]),
        end_rows(system, (its_axles[0].x, its_axles[-1].x)) if len(its_axles) > 1 else none,
        bending_rows(system, frame) if frame else none,
    ]
    ends = np.cumsum([len(rows) for rows in blocks])
    return Namer(system, its_axles, its_units, np.vstack(blocks), tuple(ends[:-1]))


def _bends(body: Body) -> TypeGuard[FlexibleBody]:
    """Whether a body is a frame whose shape is known along its length."""
    return isinstance(body, FlexibleBody) and body.role == "frame" and len(set(body.nodes[:, 0])) > 1


def name_modes(namer: Namer, modes: Modes) -> tuple[ModeName, ...]:
    """A name for each mode, no name twice."""
    if not modes.frequency_hz.size:
        return ()
    shares = _shares(namer, modes)
    described = _describe(shares)
    catalogue = named_motions(shares)
    names = list(catalogue)
    scores = np.array([catalogue[n] for n in names]).reshape(len(names), len(described))
    rows, columns = linear_sum_assignment(-scores.round(ALIKE))
    given = {
        int(mode): ModeName(names[row], float(scores[row, mode]))
        for row, mode in zip(rows, columns, strict=True)
        if scores[row, mode] >= (MINIMUM_OF_ONE if shares.is_one else MINIMUM_SCORE)
    }
    return _without_repeats(given.get(i, name) for i, name in enumerate(described))


def _shares(namer: Namer, modes: Modes) -> Shares:
    """The shares of each mode in the vehicle's motions."""
    n_modes = modes.shapes.shape[1]
    whole, wheels, rigid, ends, bending = np.split(namer.rows @ modes.shapes, namer.blocks)
    energy = kinetic_energy(namer.system, modes.shapes)
    starts = np.cumsum([0] + [len(unit.as_one) for unit in namer.units])[:-1]
    return Shares(
        namer.axles,
        namer.units,
        whole=whole**2,
        ends=ends,
        wheels=wheels.reshape(-1, 2, n_modes) ** 2,
        bending=flexibility_share(bending, modes.omega_n_squared),
        rigid=np.add.reduceat(rigid.reshape(-1, 6, n_modes) ** 2, starts),
        energy=np.array([sum(energy[b.name] for b in unit.bodies) for unit in namer.units]),
    )


def _describe(shares: Shares) -> list[ModeName]:
    """Each mode after the unit with most kinetic energy and the largest of its rigid motions.

    "engine yaw", or "box flexing" where less than half of the unit's energy is rigid.
    """
    most = shares.energy.round(ALIKE).argmax(axis=0)
    each = np.arange(len(most))
    words = [
        "vehicle" if ride else shares.units[i].word for ride, i in zip(shares.ride, most, strict=True)
    ]
    energy = np.where(shares.ride, 1.0, shares.energy[most, each])
    rigid = np.where(shares.ride, shares.whole, shares.rigid[most, :, each].T)
    flexes = rigid.sum(axis=0) < energy / 2
    motions = np.where(flexes, "flexing", np.array(MOTION_WORDS)[rigid.round(ALIKE).argmax(axis=0)])
    scores = np.where(flexes, energy, rigid.max(axis=0))
    return [
        ModeName(f"{word} {motion}", float(score))
        for word, motion, score in zip(words, motions, scores, strict=True)
    ]


def _without_repeats(names: Iterable[ModeName]) -> tuple[ModeName, ...]:
    """The names with repeats numbered, a second "box flexing" as "box flexing 2"."""
    counts: dict[str, int] = {}
    result = []
    for name in names:
        counts[name.name] = n = counts.get(name.name, 0) + 1
        result.append(name if n == 1 else ModeName(f"{name.name} {n}", name.score))
    return tuple(result)
