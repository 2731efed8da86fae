"""How close lines must lie so that sums over them hold what a load's table says between them.

A road met slowly has its humps close together in frequency, and a narrow spike of any table may fall
between two lines. So the mean squares of the load's own acceleration, f⁴ S, are summed over lines and
held against the integrals of the table, which between its values is a power law and has them in closed
form: all over the lines, and in places around every tenth of them.
"""

from collections.abc import Sequence
from itertools import count

import numpy as np

from modeviz.ride.excitation import input_spectrum, known_part, table_hz
from modeviz.ride.integration import integration_weights
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.loads import RandomLoad

IN_ALL, IN_PLACES = 2e-3, 5e-3
"""What a sum may be off, relative: over all lines 0.1 % of the root, and around a place."""

NOTHING = 1e-6
"""Of the largest mean square: what may be off around a place in any case."""

APART = 5
"""Lines between places."""

MOST = 4000
"""Lines beyond which no more are added."""


def resolving_lines(loads: Sequence[tuple[RandomLoad, float]], lines: Floats) -> Floats:
    """Those of some lines that a load's table holds, and more between where they are too far apart.

    Args:
        loads: each with the speed on a road, m/s.
        lines: (n_lines,), Hz, evenly spaced.

    Returns:
        (m (n_held - 1) + 1,), evenly spaced, with the least m that holds all mean squares, or as many
        as `MOST` allows.

    Raises:
        ModevizError: a table holds none of the lines.
    """
    parts = [known_part(load, lines, speed) for load, speed in loads]
    held = lines[min(p.start for p in parts) : max(p.stop for p in parts)]
    pairs = zip(loads, parts, strict=True)
    return _closer(held, max(_times_closer(load, lines[p], speed) for (load, speed), p in pairs))


def _times_closer(load: RandomLoad, lines: Floats, speed: float) -> int:
    """How many times closer lines that a load's table holds should lie."""
    places = lines[:: min(APART, len(lines) - 1)]
    exact = _exact(load, lines, speed, places)
    return next(
        m
        for m in count(1)
        if len(lines) * (m + 1) > MOST or _holds(_summed(load, _closer(lines, m), speed, places), exact)
    )


def _closer(lines: Floats, m: int) -> Floats:
    """The same lines and m - 1 between each two, (m (n_lines - 1) + 1,)."""
    closer = np.linspace(lines[0], lines[-1], m * (len(lines) - 1) + 1)
    closer[::m] = lines
    return closer


def _holds(found: Floats, exact: Floats) -> bool:
    """Whether mean squares around places, (n_places, n_inputs), are what they should be."""
    off, slack = found - exact, NOTHING * exact.sum(axis=0).max()
    in_all = np.abs(off.sum(axis=0)) <= IN_ALL * exact.sum(axis=0) + slack
    return bool(in_all.all() and (np.abs(off) <= IN_PLACES * exact + slack).all())


def _summed(load: RandomLoad, lines: Floats, speed: float, places: Floats) -> Floats:
    """Mean squares by a sum over lines, around places, (n_places, n_inputs)."""
    weights = integration_weights(lines, (lines[0], lines[-1]))[:, None]
    return _in_places(lines, weights * _acceleration(load, lines, speed), places)


def _exact(load: RandomLoad, lines: Floats, speed: float, places: Floats) -> Floats:
    """The same integrated: between neighbouring values power is a power law.

    ∫ S df = (ln b - ln a) (v - u) / (ln v - ln u) from a to b with u = a S(a) and v = b S(b).
    """
    table = table_hz(load, speed)
    inside = table[(table > lines[0]) & (table < lines[-1])]
    f = np.union1d(inside, lines)
    f = np.sort(np.concatenate([f, (f[1:] + f[:-1]) / 2]))
    moment = np.maximum(f[:, None] * _acceleration(load, f, speed), np.finfo(float).tiny)
    rise, ratio = np.diff(moment, axis=0), np.diff(np.log(moment), axis=0)
    is_level = np.abs(ratio) < 1e-6
    mean = np.where(is_level, moment[1:], rise / np.where(is_level, 1, ratio))
    return _in_places((f[1:] + f[:-1]) / 2, np.diff(np.log(f))[:, None] * mean, places)


def _acceleration(load: RandomLoad, f: Floats, speed: float) -> Floats:
    """f⁴ S of every input, (n_freqs, n_inputs)."""
    S = input_spectrum(load, f, speed)
    return (f[:, None] ** 4 * np.diagonal(S, axis1=1, axis2=2).real).astype(np.float64)


def _in_places(f: Floats, values: Floats, places: Floats) -> Floats:
    """Values shared among places, (n_places, n_inputs), by cubic B-splines, which are smooth."""
    where = np.interp(f, places, np.arange(len(places)))
    first = np.minimum(where.astype(int), len(places) - 2)
    w = (where - first)[:, None]
    found = np.zeros((len(places) + 2, values.shape[1]))
    shares = (1 - w) ** 3, 4 - 6 * w**2 + 3 * w**3, 1 + 3 * (w + w**2 - w**3), w**3
    for i, share in enumerate(shares):
        np.add.at(found, first + i, share / 6 * values)
    return found[1:-1]
