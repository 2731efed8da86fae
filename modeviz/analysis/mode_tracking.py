"""Which modes of one set of rates are which with another, by shape and by name.

Shapes are followed from one set to the other. A table of two sets compares modes of one name, wherever
their shapes went, for a mode is called after what moves. Only namesakes ("box flexing", "box flexing
2") are told apart by shape: their numbers count them by frequency and say nothing of which is which
once another of them comes or goes.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.analysis.modal_results import ModalResults, solve_modal
from modeviz.analysis.preparation import PreparedModes
from modeviz.analysis.shared_bodies import carried_momentum
from modeviz.dynamics.band import Method
from modeviz.dynamics.naming import ModeName
from modeviz.dynamics.tracking import Track, track_modes
from modeviz.vehicle.mount_rates import Rates


@dataclass(frozen=True, eq=False)
class Followed:
    """The modes with the vehicle's own rates, those with other rates, and where the former went."""

    base: ModalResults
    now: ModalResults
    track: Track
    """From the modes of `base` to those of `now`."""


def solve_followed(
    prepared: PreparedModes,
    rates: Rates,
    method: Method = "enriched",
    given: PreparedModes | None = None,
) -> Followed:
    """The modes with other mount rates, and which they are of those with the vehicle's own.

    Args:
        prepared: as of `analysis.modal_results.solve_modal`, as are rates, method and errors.
        rates: likewise.
        method: likewise.
        given: the vehicle with its mounts where they were, if they are elsewhere.
    """
    base = solve_modal(given or prepared, {}, method)
    now = solve_modal(prepared, rates, method)
    return Followed(base, now, follow(base, now))


def follow(base: ModalResults, now: ModalResults) -> Track:
    """Return where the modes of one set of rates are with another.

    Where one of both has bodies more, such as an absorber, shapes are compared by the bodies that both
    have: what of a mode is in others is no share of any.
    """
    momentum = carried_momentum(base.momentum, base.prepared.system, now.prepared.system)
    return track_modes(momentum, base.modes, now.modes)


@dataclass(frozen=True)
class Pair:
    """A mode with both sets of rates, or with one of them only."""

    before: int | None
    """Its number with the rates compared with, from zero."""
    after: int | None
    """Its number now."""
    is_weak: bool = False
    """Whether namesakes were told apart by shapes that are alike only in part."""


def pair_modes(base: ModalResults, now: ModalResults, track: Track) -> tuple[Pair, ...]:
    """Every mode of both sets of rates, once.

    A name that stands once in both sets is one mode. Namesakes are paired among themselves, where the
    track leads from one to the other; those whose shapes are nowhere clearly, if there are as many
    before as now, by rising frequency.

    Args:
        base: with the rates compared with.
        now: with the others.
        track: from the modes of `base` to those of `now`.
    """
    old, new = _by_motion(base.names), _by_motion(now.names)
    return tuple(
        pair
        for motion in old | new
        for pair in _pair_namesakes(old.get(motion, []), new.get(motion, []), track)
    )


def same_mode(results: ModalResults, mode: int, other: ModalResults) -> int | None:
    """The mode of another set of rates that one is compared with; None if there is none."""
    pairs = pair_modes(results, other, follow(results, other))
    return next(pair.after for pair in pairs if pair.before == mode)


def _by_motion(names: Iterable[ModeName]) -> dict[str, list[int]]:
    """The modes of each motion, by rising frequency."""
    found: dict[str, list[int]] = {}
    for i, name in enumerate(names):
        found.setdefault(name.motion, []).append(i)
    return found


def _pair_namesakes(old: Sequence[int], new: Sequence[int], track: Track) -> Iterator[Pair]:
    if len(old) == len(new) == 1:
        yield Pair(old[0], new[0])
        return
    pairs = [Pair(i, int(track.index[i]), bool(track.weak[i])) for i in old if track.index[i] in new]
    old_rest = [i for i in old if i not in {p.before for p in pairs}]
    new_rest = [i for i in new if i not in {p.after for p in pairs}]
    yield from pairs
    if len(old_rest) == len(new_rest) and not _are_elsewhere(old_rest, new_rest, track):
        yield from (Pair(b, a, is_weak=True) for b, a in zip(old_rest, new_rest, strict=True))
    else:
        yield from (Pair(i, None) for i in old_rest)
        yield from (Pair(None, i) for i in new_rest)


def _are_elsewhere(old: Sequence[int], new: Sequence[int], track: Track) -> bool:
    """Return whether one's shape clearly is, or was, a mode of another name."""
    clear = ~track.weak
    return bool(clear[list(old)].any() or np.isin(new, track.index[clear]).any())
