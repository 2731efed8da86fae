"""The set compared with and the present rates, side by side, as page text."""

import math
from collections.abc import Mapping
from html import escape

import numpy as np

from modeviz.analysis.results import Results
from modeviz.report.rate_fields import plain, quantity, with_unit
from modeviz.text.wording import number, sentence_case, signed
from modeviz.units import QuantityName, factor
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.mount_rates import DIRECTIONS, RATE_FIELDS
from modeviz.vehicle.placement import Placement
from modeviz.viewer.page.widgets.html import change, heading, named, row, span, table
from modeviz.viewer.panels.figures import DRIVER
from modeviz.viewer.panels.modes import listed, moved_by
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.cursor import has_ride
from modeviz.viewer.session.design import named_sets, variant_name
from modeviz.viewer.session.responses import Responses
from modeviz.viewer.session.state import ResponseCurve
from modeviz.viewer.session.wheel_responses import NOW

LEAST_HZ = 0.005
"""Smaller changes of a frequency are not listed."""


def side_by_side(solved: Solved) -> str:
    """Rates that differ, frequencies that moved, and the figures of the ride."""
    state, base, now = solved.state, solved.base, solved.now
    names = escape(state.against), escape(variant_name(now.prepared.vehicle, state.design))
    rates, places = _rates(base, now, state.units), _places(solved)
    parts = _absorbers(solved)
    if not rates and not places and not parts:
        same = f"The present rates are those of {names[0]}: change one, or compare with another set."
        return heading("Side by side") + span(same, "dim")
    sections = [(f"Rates, {state.units['stiffness']}", rates), ("Modes, Hz", _modes(solved))]
    sections.append(("Driver", _figures(solved)))
    tables = "".join(table((what, *names, "change"), rows) for what, rows in sections if rows)
    placed = table(("Mounts placed", *names), places) if places else ""
    added = table(("Absorbers", *names), parts) if parts else ""
    return heading("Side by side") + f'<div class="beside">{added}{placed}{tables}</div>'


def _absorbers(solved: Solved) -> list[str]:
    """Absorbers that were added in one of both, or are of another mass in them."""
    design, vehicle = solved.state.design, solved.now.prepared.vehicle
    sides = named_sets(vehicle, design)[solved.state.against].alterations, design.alterations
    names = dict.fromkeys(absorber.name for side in sides for absorber in side.absorbers)
    found = ((name, [side.absorber(name) for side in sides]) for name in names)
    return [
        row([named(name), *map(_weight, both)])
        for name, both in found
        if _weight(both[0]) != _weight(both[1])
    ]


def _weight(absorber: Absorber | None) -> str:
    return f"{absorber.mass:.4g} kg" if absorber else "–"


def _places(solved: Solved) -> list[str]:
    """How the mounts of groups are moved and turned, where that differs."""
    design, vehicle = solved.state.design, solved.now.prepared.vehicle
    before = named_sets(vehicle, design)[solved.state.against].alterations
    rows = []
    for group in filter(solved.base.rates.__contains__, solved.now.rates):
        placements = before.placement(group), design.alterations.placement(group)
        if placements[0] != placements[1]:
            rows.append(row([named(group), *map(_placed, placements)]))
    return rows


def _placed(placement: Placement) -> str:
    """How mounts are placed, in mm along and degrees about x, y, z."""
    if placement.is_as_given:
        return "as in the file"
    values = (
        (1e3 * np.array(placement.offset), " mm"),
        (np.degrees(placement.angles), "°"),
    )
    words = (", ".join(f"{v:.4g}" for v in vector) + unit for vector, unit in values if vector.any())
    return "; ".join(words)


def _rates(base: Results, now: Results, units: Mapping[QuantityName, str]) -> list[str]:
    """Rates that differ; those that are not along axes with their unit."""
    rows = []
    shared = (
        (group, base.rates[group], new) for group, new in now.rates.items() if group in base.rates
    )
    for group, old, new in shared:
        for field in RATE_FIELDS:
            of = quantity(field)
            before, after = (getattr(rates, field) / factor(units[of], of) for rates in (old, new))
            if before != after:
                delta = signed(100 * (after / before - 1), 0, " %") if before else "new"
                name = named(f"{group} {with_unit(field, units)}")
                rows.append(row([name, plain(before), plain(after), delta]))
        if old.loss_factor != new.loss_factor:
            rows.append(row([named(f"{group} loss factor"), *_losses(base, now, group)]))
    return rows


def _losses(base: Results, now: Results, group: str) -> tuple[str, str, str]:
    before, after = (r.vehicle.mount_group(group).loss_factor for r in (base, now))
    return f"{before:.3g}", f"{after:.3g}", signed(after - before, 3)


def _modes(solved: Solved) -> list[str]:
    """The modes that both have and that moved, and those that only one has."""
    base, now = solved.base, solved.now
    before, after = listed(base), listed(now)
    rows = []
    for pair in solved.followed.pairs:
        old, new = _frequency(base, pair.before), _frequency(now, pair.after)
        is_listed = pair.before in before or pair.after in after
        if not is_listed or abs(new - old) < LEAST_HZ:
            continue
        texts = ["–" if math.isnan(f) else f"{f:.2f}" for f in (old, new)]
        if pair.after is not None:
            cells = [
                named(sentence_case(now.names[pair.after].spoken)),
                *texts,
                moved_by(solved, pair.after),
            ]
            rows.append((new, row(cells)))
        elif pair.before is not None:
            rows.append((old, row([named(sentence_case(base.names[pair.before].spoken)), *texts, ""])))
    return [cells for _, cells in sorted(rows)]


def _frequency(results: Results, mode: int | None) -> float:
    """Not a number if there is no mode."""
    return math.nan if mode is None else float(results.modes.frequency_hz[mode])


def _figures(solved: Solved) -> list[str]:
    if not solved.state.charts.curves:
        return []
    responses = Responses(solved)
    scale, unit = (1, "RMS g") if responses.is_random else (1000, "mean 10⁻³ g")
    if responses.running(NOW) is not None:
        unit = "idle 10⁻³ g"
    rows = []
    for direction in DIRECTIONS:
        curve = ResponseCurve(DRIVER, direction)
        old, new = (responses.figure(name, curve) for name in (solved.state.against, NOW))
        texts = (f"{scale * value:.3f}" for value in (old, new))
        rows.append(row([f"{sentence_case(direction)}, {unit}", *texts, change(new, old)]))
    if not has_ride(solved.now.prepared.vehicle):
        return rows
    old, new = (r.rating.mean_personal_rating for r in (solved.base, solved.now))
    rows.append(row(["Rating", number(old, 2), number(new, 2), signed(new - old, 2)]))
    return rows
