"""The report's sections on mounts and modes; one that has nothing to say is empty."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from html import escape

import numpy as np

from modeviz.analysis.modal_results import ModalResults
from modeviz.analysis.mode_tracking import Pair, pair_modes
from modeviz.analysis.results import Results
from modeviz.dynamics.modes import RESOLVED_HZ
from modeviz.optimise.outside import outside_space
from modeviz.report.comparison import Comparison, ObjectiveValues
from modeviz.report.optimum import objective_words
from modeviz.report.rate_fields import listed_fields, with_unit
from modeviz.report.space import outside_words, ratio_words
from modeviz.ride.psd import power_decibels
from modeviz.text.axes import shown_hz
from modeviz.text.markup import NONE, change, named_small, note, section, span, table, title
from modeviz.text.wording import number, percent_change, signed, significant
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import spoken_value
from modeviz.vehicle.vehicle import Vehicle

LISTED_HZ = 25.0
"""Above, mounts do little."""


def rates(comparison: Comparison) -> str:
    """Mount rates, as the paper's Table 4, and the loss factors that are not the same.

    Beside both sets stands what the vehicle's usual problem is compared with, if that is neither.
    """
    sets = [
        (comparison.names[0], comparison.base.vehicle),
        (comparison.names[1], comparison.now.vehicle),
        *_reference(comparison),
    ]
    known = [{group.name: group for group in vehicle.mount_groups} for _, vehicle in sets]
    names = dict.fromkeys(name for groups in known for name in groups)
    rows = [row for name in names for row in _group_rows([groups.get(name) for groups in known])]
    if not rows:
        return ""
    first, *others = (f"{escape(name)}, N/mm" for name, _ in sets)
    header = ["Mount", first, *(cell for name in others for cell in (name, "Change"))]
    return section("Mount rates", table(header, rows))


def objective(comparison: Comparison) -> str:
    """The section on the vehicle's usual problem: its goal with the same sets as in `rates`.

    Values are parts of the original's, if that has any.
    """
    worth = comparison.worth
    if worth is None:
        return ""
    of = worth.original or 1.0
    names, values = [*comparison.names], [worth.base / of, worth.now / of]
    if _reference(comparison) and worth.reference is not None:
        names, values = [*names, worth.problem.reference], [*values, worth.reference / of]
    first, *others = map(escape, names)
    header = ["", first, *(cell for name in others for cell in (name, "Change"))]
    compared = [c for v in values[1:] for c in (significant(v), change(v, values[0]))]
    problem = escape(worth.problem.name)
    parts = ", as parts of the original’s" if worth.original else ""
    return section(
        "Objective",
        table(header, [[title(worth.problem.name), significant(values[0]), *compared]]),
        note(f"What the problem “{problem}” makes small: {objective_words(worth.problem)}{parts}."),
        *(note(f"{escape(line)}.") for line in _space(comparison, worth)),
    )


def _space(comparison: Comparison, worth: ObjectiveValues) -> list[str]:
    """Lines on the ratios that a search from the own rates keeps, and on sets out of its reach."""
    if worth.space is None:
        return []
    vehicles = [comparison.base.vehicle, comparison.now.vehicle]
    sets = [*zip(comparison.names, vehicles, strict=True), *_reference(comparison)]
    ratios = ratio_words(worth.space)
    said = [f"A search from the original rates keeps {ratios}"] if ratios else []
    for name, vehicle in sets:
        sought = [group for group in vehicle.mount_groups if group.name in worth.space.vehicle.rates]
        rates = {g.name: replace(g.rates, loss_factor=g.loss_factor) for g in sought}
        said.append(outside_words(f"“{name}”", outside_space(worth.space, rates)))
    return [text for text in said if text]


def _reference(comparison: Comparison) -> list[tuple[str, Vehicle]]:
    """The set that the usual problem is compared with, by name; nothing if it is one of both."""
    vehicle = comparison.vehicle
    name = vehicle.problems[0].reference if vehicle.problems else ""
    if not name or name in comparison.names:
        return []
    return [(name, vehicle.with_rates(vehicle.rate_sets[name]))]


def _group_rows(groups: Sequence[MountGroup | None]) -> Iterator[list[str]]:
    """Rows of one group's rates with each set; None where a set is without it."""
    first, *others = there = [group for group in groups if group is not None]
    yield [named_small(first.name, first.label)]
    for field in listed_fields(first, *(group.rates for group in others)):
        rates = [None if group is None else spoken_value(group.rates, field) for group in groups]
        yield [with_unit(field), *_rate_cells(rates)]
    if len({group.loss_factor for group in there}) > 1:
        yield ["loss factor", *_rate_cells([group and group.loss_factor for group in groups])]


def _rate_cells(values: Sequence[float | None]) -> list[str]:
    """The first, and each other with its change; nothing where there is none."""
    base, *others = values
    cells = [NONE if base is None else significant(base)]
    for now in others:
        change = NONE if now is None or base is None else _change(now, base)
        cells += [NONE if now is None else significant(now), change]
    return cells


def frequencies(comparison: Comparison) -> str:
    """Natural frequencies by name, as the paper's Table 1, and where the shapes went."""
    rows = [_mode_row(comparison, pair) for pair in _pairs(comparison)]
    first, second = map(escape, comparison.names)
    groups = [("", 1), ("Frequency, Hz", 2), ("Change", 2), ("Damping, %", 2), ("", 1)]
    header = ["Mode", first, second, "Hz", "%", first, second, "The shape went to"]
    return section(
        f"Natural frequencies below {LISTED_HZ:g} Hz",
        table(header, rows, groups, words={7}),
        note(
            "Modes are called after what moves; “~” says that a name fits weakly. Where the shape of a "
            f"mode of “{first}” has gone to one of another name, or to several, the last column says "
            "which and how much of the shape each has (MAC)."
        ),
    )


def _pairs(comparison: Comparison) -> list[Pair]:
    """The pairs of modes that are listed with either set of rates, by rising frequency."""
    base, now = comparison.base, comparison.now
    before, after = set(_below(base)), set(_below(now))

    def frequency(pair: Pair) -> float:
        if pair.before is not None:
            return float(base.modes.frequency_hz[pair.before])
        return float(now.modes.frequency_hz[pair.after])

    pairs = pair_modes(base, now, comparison.track)
    return sorted((p for p in pairs if p.before in before or p.after in after), key=frequency)


def _mode_row(comparison: Comparison, pair: Pair) -> list[str]:
    """A mode with both sets of rates; with one of them there may be none to compare with."""
    before, after = pair.before, pair.after
    sides = ((comparison.base, before), (comparison.now, after))
    found = [(r, i) for r, i in sides if i is not None]
    changes = [NONE, NONE]
    if len(found) == 2:
        f, f_now = (float(r.modes.frequency_hz[i]) for r, i in found)
        mark = "~" if pair.is_weak else ""
        changes = [mark + signed(f_now - f, 2), signed(100 * (f_now / f - 1), 1)]
    return [
        _name(found),
        *(_frequency(r, i) for r, i in sides),
        *changes,
        *(NONE if i is None else f"{100 * r.modes.damping_ratio[i]:.1f}" for r, i in sides),
        NONE if before is None else _went_to(comparison, before, after),
    ]


def _name(found: Sequence[tuple[ModalResults, int]]) -> str:
    """The name of a mode, and what it was if a namesake came or went."""
    *was, now = (results.names[mode].name for results, mode in found)
    return title(now) + (f" <small>was {escape(was[0])}</small>" if was not in ([], [now]) else "")


def _frequency(results: ModalResults, mode: int | None) -> str:
    if mode is None:
        return NONE
    mark = "~" if results.names[mode].is_weak else ""
    return f"{mark}{results.modes.frequency_hz[mode]:.2f}"


def _went_to(comparison: Comparison, before: int, after: int | None) -> str:
    """The modes that may be called a shape's now, where that is not clear from the name."""
    track, now = comparison.track, comparison.now
    holders = track.holders(before)
    if not holders:
        return "above the band"
    if track.index[before] == after and not track.weak[before]:
        return ""
    return "; ".join(
        f"{escape(now.names[i].spoken)}, {now.modes.frequency_hz[i]:.2f} Hz "
        f"<small>(MAC {mac:.2f})</small>"
        for i, mac in holders
    )


def participation(comparison: Comparison) -> str:
    """The modes that make the peaks at the driver's point, as the paper's Table 2."""
    rides = comparison.rides
    if rides is None:
        return ""
    rows = []
    for direction in ("vertical", "lateral"):
        for name, results in zip(comparison.names, rides, strict=True):
            rows.append([f"{direction.capitalize()}, {escape(name)}"])
            rows.extend(_peak_rows(results, direction))
    groups = [("Response peak", 2), ("Largest contributor", 2), ("Second largest", 3)]
    header = ["Hz", "dB re 1 g²/Hz", "Hz", "Mode", "Hz", "Mode", "Ratio"]
    point = escape(comparison.vehicle.response_points[0].name)
    return section(f"Modes in the peaks at {point}", table(header, rows, groups, words={3, 5}))


def _peak_rows(results: Results, direction: str) -> Iterator[list[str]]:
    low, high = shown_hz(results.prepared.vehicle.highest_frequency)
    for peak in results.peaks(0, direction, 2):
        if low <= peak.frequency_hz <= high:
            cells = [f"{peak.frequency_hz:.2f}", number(float(power_decibels(np.array(peak.level))), 1)]
            for c in peak.contributors:
                f = results.part_frequency(c.mode)
                cells += [NONE if f is None else f"{f:.2f}", escape(results.part_name(c.mode))]
            if len(peak.contributors) == 2:
                cells.append(f"{peak.contributors[1].ratio:.2f}")
            yield cells + [NONE] * (7 - len(cells))


def _change(now: float, base: float) -> str:
    text = percent_change(now, base)
    return span(text, "dim") if now == base else text


def _below(results: ModalResults) -> list[int]:
    """The modes that are listed; what moves freely is none that mounts change."""
    f = results.modes.frequency_hz
    return np.flatnonzero((f > RESOLVED_HZ) & (f < LISTED_HZ)).tolist()
