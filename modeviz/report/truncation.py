"""Words for how much too stiff bodies are that lack residual vectors."""

import math
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.component_trust import component_trust
from modeviz.dynamics.truncation_gap import (
    FAIR,
    SURE,
    TruncationGap,
    gap_if_solved,
    on_trial_mounts,
    stiff_connections,
)
from modeviz.errors import listed, quoted
from modeviz.report.components import change_words
from modeviz.report.stiff_connections import stiff_words
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.residual_estimate import estimate_residuals
from modeviz.vehicle.vehicle import Vehicle

SMALL = 0.005
"""Nobody minds frequencies that are too high by less than this part of them."""

REMEDY = "ask the solver for residual vectors there, or give their compliance with --residual"


def truncation_doubts(vehicle: Vehicle) -> Iterator[str]:
    """Yield sentences on a vehicle whose bodies are too stiff where its connections hold them.

    Of one that cannot be solved there are none.
    """
    gap = gap_if_solved(vehicle)
    if gap is not None:
        yield from gap_doubts(gap, vehicle)


def gap_doubts(gap: TruncationGap, vehicle: Vehicle) -> Iterator[str]:
    """Yield the sentences on a vehicle of which it is known how much too high its frequencies are."""
    for body in gap.bodies:
        if stiff := [s for s in stiff_connections(vehicle) if s.body == body]:
            lack = _lack(vehicle.body(body))
            yield f"body {quoted(body)} {lack} where {stiff_words(stiff)}"
    if is_large(gap):
        yield f"{gap_words(gap)}; {REMEDY}"


def gap_words(gap: TruncationGap) -> str:
    """Return by how much frequencies are too high."""
    return f"frequencies below {gap.below_hz:.3g} Hz are {_too_high(gap)}"


def is_large(gap: TruncationGap) -> bool:
    """Whether somebody minds it."""
    return gap.change > SMALL


def at_rates(which: str, gap: TruncationGap) -> str:
    """Return a sentence on how much too high frequencies are at some rates, and why."""
    bodies = listed(map(quoted, gap.bodies))
    why = f"as there are no or too few residual vectors of {bodies}"
    return f"At {which} {gap_words(gap)}, {why}; {REMEDY}."


def gap_record(gap: TruncationGap | None) -> dict[str, Any] | None:
    """The fields of a gap as JSON has them, null for none."""
    return None if gap is None else asdict(gap)


def import_notes(body: FlexibleBody) -> Iterator[str]:
    """Yield what an imported body says of its truncation, on mounts a tenth as stiff as itself."""
    vehicle = on_trial_mounts(body)
    gap = gap_if_solved(vehicle) if body.attachments else None
    if gap is None:
        return
    missing = estimate_residuals(body).compliance
    names = [quoted(a.name) for a, r in zip(body.attachments, missing, strict=True) if r.any()]
    yield (
        f"body {quoted(body.name)} {_lack(body)}, so it is too stiff at {listed(names)}: on mounts a "
        f"tenth as stiff as it is there, {gap_words(gap)}"
    ) + (f"; {REMEDY}" if gap.change > SMALL else "")
    (trust,) = component_trust(assemble(vehicle), gap.below_hz)
    n_elastic = body.n_normal - body.n_rigid
    wanted = math.ceil(n_elastic * gap.change / SMALL)
    more = f"; for {SMALL:.1%} about {wanted} are wanted" if wanted > n_elastic else ""
    fewer = f"{trust.n_left_out} of its {n_elastic} elastic modes"
    yield f"body {quoted(body.name)}: without the last {fewer} {change_words(trust)} there{more}"


def _lack(body: Body) -> str:
    """What there is too little of."""
    if not isinstance(body, FlexibleBody) or not body.n_residuals:
        return "lacks residual vectors"
    return (
        f"gives way too little along some directions even with its {body.n_residuals} residual vectors"
    )


def _too_high(gap: TruncationGap) -> str:
    """By how much, and how well that is known; of what is little even at its upper end, that it is."""
    if gap.change * gap.within <= SMALL:
        return f"too high by less than {_percent(SMALL)}, too little to matter"
    return f"too high by up to about {_percent(gap.change)} (at {gap.at_hz:.3g} Hz; {_sure(gap)})"


def _sure(gap: TruncationGap) -> str:
    """How well it is known."""
    if gap.within <= SURE.within:
        return "an estimate within a factor of two"
    if gap.within <= FAIR.within:
        least, most = _percent(gap.change / gap.within), _percent(gap.change * gap.within)
        return f"an estimate, between {least} and {most}"
    least = _percent(gap.at_least)
    return f"these modes tell the order of magnitude alone; it is at least {least}"


def _percent(part: float) -> str:
    return f"{100 * part:.2g} %"
