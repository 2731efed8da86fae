"""Where each mode goes while mount rates move.

A mode is recognised from one step to the next by the modal assurance criterion weighted with mass,
MAC = (φ_oldᵀ M φ_new)² of mass-normalised shapes (R. J. Allemang, "The modal assurance criterion:
twenty years of use and abuse", 2003). All modes of a step are assigned together, and a step in which a
followed shape changes too much is halved, so what is followed is a shape that changes by little at a
time. Modes that cross go through each other; modes that veer stay on their branches, and their shapes
change places.

Modes closer than `CLOSE` count as any mixture of each other: their space is compared, not the mixture
that happens to come out of the solver. So repeated modes keep their identity, and a veering narrower
than that is passed as the crossing which, with damping, it cannot be told from.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import linear_sum_assignment

from modeviz.dynamics.assembly import System
from modeviz.dynamics.modes import RESOLVED_HZ, Modes
from modeviz.vehicle.arrays import Floats

STEP_MAC = 0.9
"""A step with less is halved; what has less in the least step is uncertain."""

LEAST_STEP = 1 / 64
"""Of a path: the step that is not halved."""

WEAK_MAC = 0.5
"""Below this most of the start's shape is in other modes than the one that carries on its identity."""

LEFT_MAC = 0.1
"""Below this no mode is the continuation of another: it has left the band that was solved."""

CLOSE = 0.02
"""Relative difference in frequency, the half-power bandwidth of a mode with 1 % of critical damping."""

SAME = 0.99
"""MAC of shapes that are the same: close modes that are recognised like that need no mixing."""

REPEATED = 1e-6
"""Relative difference in frequency that rounding may make."""


@dataclass(frozen=True, eq=False)
class Track:
    """Where each mode of a start, the last accepted set of rates, has gone."""

    system: System
    """Its mass, which no rate changes."""
    start: Modes
    """The first of them are followed closely."""
    n_followed: int
    """How many; the others are carried along, so that none is mistaken for what leaves the band."""
    start_momentum: Floats
    """M φ of the start's shapes, (n_dofs, n_start)."""
    seen_momentum: Floats
    """M φ of their shapes where they were last seen, (n_dofs, n_start)."""
    index: np.ndarray
    """(n_start,) int: which of the present modes each is; -1 if it left the band."""
    frequency_hz: Floats
    """(n_start,): of that mode; not a number if it left."""
    last_mac: Floats
    """(n_start,): MAC over the last step; zero outside the band."""
    step_mac: Floats
    """(n_start,): the lowest MAC over any step."""
    shares: Floats
    """(n_start, n_present): how much of each start's shape is in each present mode, close ones mixed;
    the shares of a shape sum to one less what is outside the band."""

    @property
    def mac(self) -> Floats:
        """MAC of each start's shape with the mode that it has become, (n_start,); zero if it left."""
        return np.where(self.index < 0, 0.0, self.shares[np.arange(len(self.index)), self.index])

    @property
    def weak(self) -> np.ndarray:
        """Whose identity is uncertain, by a step or because its shape has changed, (n_start,) bool."""
        return (self.step_mac < STEP_MAC) | (self.mac < WEAK_MAC)

    def origin(self, mode: int) -> int | None:
        """Which mode of the start has become this present one; None if none has."""
        before = np.flatnonzero(self.index == mode)
        return int(before[0]) if before.size else None

    def split(self, mode: int, count: int = 3) -> list[tuple[int, float]]:
        """The present modes that have most of a start's shape, and how much."""
        largest = np.argsort(-self.shares[mode])[:count]
        return [(int(i), float(self.shares[mode, i])) for i in largest]


def start_track(system: System, modes: Modes, n_followed: int) -> Track:
    """A track at its start; `n_followed` of the modes, the lowest, decide how small steps must be."""
    momentum = system.momentum(modes.shapes)
    n_modes = modes.shapes.shape[1]
    ones = np.ones(n_modes)
    return Track(
        system,
        modes,
        n_followed,
        start_momentum=momentum,
        seen_momentum=momentum,
        index=np.arange(n_modes),
        frequency_hz=modes.frequency_hz,
        last_mac=ones,
        step_mac=ones,
        shares=np.eye(n_modes),
    )


def follow(track: Track, modes: Modes, between: Callable[[float], Modes]) -> Track:
    """The track led on to other rates, in steps as small as the shapes need.

    Args:
        track: up to where it has come.
        modes: with the rates to go to.
        between: the modes with rates on the way: at 0 those of `track`, at 1 those of `modes`.
    """
    done, ahead = 0.0, [(1.0, modes)]
    while ahead:
        end, modes = ahead[-1]
        stepped = step(track, modes)
        if _is_small(track, stepped) or end - done <= LEAST_STEP:
            track, done = stepped, end
            ahead.pop()
        else:
            middle = (done + end) / 2
            ahead.append((middle, between(middle)))
    return track


def step(track: Track, modes: Modes) -> Track:
    """The track led on by one step, however large."""
    if track.seen_momentum is track.start_momentum:  # it has not moved yet
        track = _mixed_start(track, modes)
    products = track.seen_momentum.T @ modes.shapes
    mixing = _mixing(products, modes.frequency_hz, CLOSE)
    mac = (products @ mixing) ** 2
    rows, columns = linear_sum_assignment(-mac)
    stays = mac[rows, columns] >= LEFT_MAC
    rows, columns = rows[stays], columns[stays]
    index, last_mac = np.full(len(mac), -1), np.zeros(len(mac))
    index[rows], last_mac[rows] = columns, mac[rows, columns]
    frequency_hz = np.full(len(mac), np.nan)
    frequency_hz[rows] = modes.frequency_hz[columns]
    seen_momentum = track.seen_momentum.copy()
    seen_momentum[:, rows] = track.system.momentum(modes.shapes) @ mixing[:, columns]
    return replace(
        track,
        seen_momentum=seen_momentum,
        index=index,
        frequency_hz=frequency_hz,
        last_mac=last_mac,
        step_mac=np.minimum(track.step_mac, last_mac),
        shares=(track.start_momentum.T @ modes.shapes @ mixing) ** 2,
    )


def _is_small(before: Track, after: Track) -> bool:
    """Whether a step loses no followed mode from sight.

    Each that was in the band is clearly recognised, and those that change their order were close before
    or after: else they may have veered in between and only look as if they had crossed.
    """
    followed = slice(before.n_followed)
    recognised = (after.last_mac >= STEP_MAC) | (before.index < 0)
    gaps_before, gaps_after = (_gaps(t.frequency_hz[followed]) for t in (before, after))
    far = (np.abs(gaps_before) > CLOSE) & (np.abs(gaps_after) > CLOSE)
    crossed = far & (gaps_before * gaps_after < 0)
    return bool(recognised[followed].all() and not crossed.any())


def _gaps(frequency_hz: Floats) -> Floats:
    """How much higher each mode is than each other, relative, (n_modes, n_modes)."""
    f = np.maximum(frequency_hz, RESOLVED_HZ)
    return f[:, None] / f - 1


def _mixed_start(track: Track, modes: Modes) -> Track:
    """A track that has not moved yet, its repeated modes mixed as they are after the first step."""
    products = modes.shapes.T @ track.start_momentum
    momentum = track.start_momentum @ _mixing(products, track.start.frequency_hz, REPEATED)
    return replace(track, start_momentum=momentum, seen_momentum=momentum)


def _mixing(products: Floats, frequency_hz: Floats, closeness: float) -> Floats:
    """How to mix close modes so that they are as near to other shapes as can be, (n_modes, n_modes).

    Each close set is rotated within its own space onto as many of the others as it has members, those
    that lie in that space most (orthogonal Procrustes: P. H. Schönemann, 1966); each mixture then
    stands in place of the member that it has most of. What moves freely is one set; a set in which
    every mode is recognised as it is stays as it is.

    Args:
        products: φ_otherᵀ M φ, (n_others, n_modes).
        frequency_hz: of the modes to be mixed, (n_modes,).
        closeness: the relative difference in frequency below which modes are close.
    """
    mixing = np.eye(len(frequency_hz))
    for members in _close(frequency_hz, closeness):
        shared = products[:, members]
        if ((shared**2).max(axis=0) > SAME).all():
            continue
        nearest = np.sort(np.argsort(-(shared**2).sum(axis=1))[: shared.shape[1]])
        u, _, vt = np.linalg.svd(shared[nearest].T)
        rotation = u @ vt
        _, order = linear_sum_assignment(-(rotation**2))
        mixing[members, members] = rotation[:, order]
    return mixing


def _close(frequency_hz: Floats, closeness: float) -> list[slice]:
    """The runs of modes that are close to their neighbours."""
    f = np.where(frequency_hz < RESOLVED_HZ, 0.0, frequency_hz)
    begins = np.flatnonzero(np.diff(f, prepend=-1.0) > closeness * f)
    ends = np.append(begins[1:], len(f))
    return [slice(b, e) for b, e in zip(begins, ends, strict=True) if e - b > 1]
