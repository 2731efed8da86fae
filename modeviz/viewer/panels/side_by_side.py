"""The set compared with and the present rates, side by side, as page text."""

from html import escape

from modeviz.dynamics.naming import ModeName
from modeviz.export.wording import number, sentence_case, signed
from modeviz.tuning.results import Results
from modeviz.units import factor
from modeviz.vehicle.connections import DIRECTIONS, RATE_FIELDS
from modeviz.viewer.answers import Solved
from modeviz.viewer.html import change, heading, row, span, table, title
from modeviz.viewer.panels.figures import DRIVER
from modeviz.viewer.panels.modes import listed
from modeviz.viewer.responses import NOW, Responses
from modeviz.viewer.state import Curve, variant_name

LEAST_HZ = 0.005
"""Smaller changes of a frequency are not listed."""


def side_by_side(solved: Solved) -> str:
    """Rates that differ, frequencies that moved, and the figures of the ride."""
    state, base, now = solved.state, solved.base, solved.now
    names = escape(state.against), escape(variant_name(now.prepared.vehicle, state))
    rates = _rates(base, now, state.unit)
    if not rates:
        same = f"The present rates are those of {names[0]}: change one, or compare with another set."
        return heading("Side by side") + span(same, "dim")
    sections = [(f"Rates, {state.unit}", rates), ("Modes, Hz", _modes(base, now))]
    sections.append(("Driver", _figures(solved)))
    tables = "".join(table((what, *names, "change"), rows) for what, rows in sections if rows)
    return heading("Side by side") + f'<div class="beside">{tables}</div>'


def _rates(base: Results, now: Results, unit: str) -> list[str]:
    per_unit = factor(unit, "stiffness")
    rows = []
    for group, new in now.rates.items():
        old = base.rates[group]
        for field, direction in zip(RATE_FIELDS, DIRECTIONS, strict=True):
            before, after = getattr(old, field) / per_unit, getattr(new, field) / per_unit
            if before != after:
                delta = signed(100 * (after / before - 1), 0, " %") if before else "new"
                rows.append(row([f"{escape(group)} {direction}", _plain(before), _plain(after), delta]))
        if old.loss_factor != new.loss_factor:
            rows.append(row([f"{escape(group)} loss factor", *_losses(base, now, group)]))
    return rows


def _losses(base: Results, now: Results, group: str) -> tuple[str, str, str]:
    before, after = (r.vehicle.mount_group(group).loss_factor for r in (base, now))
    return f"{before:.3g}", f"{after:.3g}", signed(after - before, 3)


def _modes(base: Results, now: Results) -> list[str]:
    """The modes that both have and that moved, and those that only one has."""
    before, after = _named(base), _named(now)
    rows = []
    for name in sorted({*before, *after}, key=lambda n: (after.get(n) or before[n])[1]):
        old, new = before.get(name), after.get(name)
        if old and new and abs(new[1] - old[1]) < LEAST_HZ:
            continue
        spoken = (new or old or (name, 0.0))[0]
        frequencies = [f"{f[1]:.2f}" if f else "–" for f in (old, new)]
        delta = signed(new[1] - old[1], 2) if old and new else ""
        rows.append(row([title(spoken), *frequencies, delta]))
    return rows


def _named(results: Results) -> dict[str, tuple[str, float]]:
    """The modes of the ride band by name: what they are called on the page, and frequency."""
    modes: list[tuple[ModeName, float]] = list(listed(results).values())
    return {name.name: (name.spoken, f) for name, f in modes}


def _figures(solved: Solved) -> list[str]:
    if not solved.state.curves:
        return []
    responses = Responses(solved)
    scale, unit = (1, "RMS g") if not solved.state.load else (1000, "mean 10⁻³ g")
    rows = []
    for direction in DIRECTIONS:
        curve = Curve(DRIVER, direction)
        old, new = (responses.figure(name, curve) for name in (solved.state.against, NOW))
        texts = (f"{scale * value:.3f}" for value in (old, new))
        rows.append(row([f"{sentence_case(direction)}, {unit}", *texts, change(new, old)]))
    old, new = (r.rating.mean_personal_rating for r in (solved.base, solved.now))
    rows.append(row(["Rating", number(old, 2), number(new, 2), signed(new - old, 2)]))
    return rows


def _plain(value: float) -> str:
    """A rate as one would write it, four digits or all before the point."""
    return f"{value:.0f}" if value >= 1000 else f"{value:.4g}"
