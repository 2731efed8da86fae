"""Connections that are stiff beside truncated bodies: in a few words, as a table and for JSON."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from modeviz.dynamics.truncation_gap import StiffConnection, stiff_connections
from modeviz.errors import quoted
from modeviz.report.tables import table
from modeviz.units import factor
from modeviz.vehicle.vehicle import Vehicle

MOST_NAMED = 3
"""In a sentence."""

MOST_ROWS = 20
"""Of a table."""


@dataclass(frozen=True)
class _Held:
    """What a connection is beside one of its bodies."""

    most: StiffConnection
    """In the direction in which it is the stiffest."""
    directions: str
    """In which it is stiff, "x, z"."""


def stiff_words(every: Sequence[StiffConnection]) -> str:
    """Return which connections are stiff beside a body, the stiffest first, and how stiff that is."""
    held = _by_connection(every)
    most = held[0].most
    names = [f"{quoted(h.most.connection)} ({h.directions})" for h in held[:MOST_NAMED]]
    more = f" and {len(held) - MOST_NAMED} more" if len(held) > MOST_NAMED else ""
    own = "is rigid" if math.isinf(most.stiffness) else f"has {_rate(most.stiffness)} N/mm"
    where = "there" if most.attachment == most.connection else f"at {quoted(most.attachment)}"
    return (
        f"connections are stiffer than a tenth of it: {', '.join(names)}{more}; the most, "
        f"{quoted(most.connection)} along {most.direction}, {own}, and the body about "
        f"{_rate(most.local_stiffness)} N/mm {where}"
    )


def stiff_table(vehicle: Vehicle) -> str:
    """Return those of a vehicle, the stiffest beside a body first; empty if words name all of them."""
    every = list(stiff_connections(vehicle))
    bodies = [[s for s in every if s.body == body] for body in dict.fromkeys(s.body for s in every)]
    if all(len(_by_connection(of_body)) <= MOST_NAMED for of_body in bodies):
        return ""
    held = sorted((h for of_body in bodies for h in _by_connection(of_body)), key=_softness)
    header = ["connection", "body", "stiff along", "most", "N/mm", "body's N/mm"]
    rows = [
        [
            h.most.connection,
            h.most.body,
            h.directions,
            h.most.direction,
            "rigid" if math.isinf(h.most.stiffness) else _rate(h.most.stiffness),
            _rate(h.most.local_stiffness),
        ]
        for h in held[:MOST_ROWS]
    ]
    more = [f"and {len(held) - MOST_ROWS} more; --json has all"] if len(held) > MOST_ROWS else []
    return "\n".join([table(header, rows), *more])


def stiff_record(vehicle: Vehicle) -> list[dict[str, Any]]:
    """Return all of them as JSON has them, rates in N/m, null of a rigid one."""
    return [
        asdict(stiff) | {"stiffness": None if math.isinf(stiff.stiffness) else stiff.stiffness}
        for stiff in stiff_connections(vehicle)
    ]


def _by_connection(every: Iterable[StiffConnection]) -> list[_Held]:
    """The connections of one body, that first which is the stiffest beside it."""
    found: dict[str, list[StiffConnection]] = {}
    for stiff in every:
        found.setdefault(stiff.connection, []).append(stiff)
    held = [
        _Held(min(those, key=_softness_along), ", ".join(s.direction for s in those))
        for those in found.values()
    ]
    return sorted(held, key=_softness)


def _softness(held: _Held) -> float:
    return _softness_along(held.most)


def _softness_along(stiff: StiffConnection) -> float:
    """How soft it is beside the body, in three digits, so that rounding orders nothing."""
    return float(f"{stiff.local_stiffness / stiff.stiffness:.3g}")


def _rate(stiffness: float) -> str:
    """N/mm, without powers of ten."""
    value = stiffness / factor("N/mm", "stiffness")
    return f"{value:,.0f}" if value >= 1000 else f"{value:.3g}"
