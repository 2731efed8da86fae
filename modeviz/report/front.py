"""The front of a trade-off, as plain values for JSON, as a text table and as CSV."""

import csv
import math
from io import StringIO

from modeviz.optimise.outside import kept_ratios, outside_search
from modeviz.optimise.pareto import Front, most_truncated
from modeviz.optimise.trade_off import TradeOff
from modeviz.report.optimum import objective_words, solved_from_scratch
from modeviz.report.places import place_rows, placements_record
from modeviz.report.rate_fields import listed_fields, spoken, with_unit
from modeviz.report.records import Record, rates_record
from modeviz.report.space import space_lines
from modeviz.report.tables import table
from modeviz.report.truncation import at_rates, gap_record, is_large
from modeviz.text.wording import percent_change, significant
from modeviz.vehicle.mount_rates import spoken_unit, spoken_value
from modeviz.vehicle.problem import Problem


def front_record(problem: Problem, trade_off: TradeOff, front: Front) -> Record:
    """Designs between two goals.

    `{"goal", "normalised", "between": [name, name], "original": [value, value], "designs": [{"values",
    "rates": see rates_record, "placements": see placements_record, "truncation": see optimum_record}],
    "fixed_ratios": {group: {"lateral", "fore_aft"}} to the vertical rate, "outside": {"original": why
    it could not be found, [] if it could}, "converged", "reason", "evaluations", "exact_difference": or
    null where the model as given cannot be solved so exactly}`.
    """
    search = trade_off.searches[0]
    vehicle = search.space.vehicle
    return {
        "goal": problem.goal,
        "normalised": problem.is_normalised,
        "between": list(front.names),
        "original": _original(trade_off),
        "designs": [
            {
                "values": list(d.values),
                "rates": rates_record(vehicle.with_rates(d.rates)),
                "placements": placements_record(d.placements),
                "truncation": gap_record(d.verification.gap if d.verification else None),
            }
            for d in front.designs
        ],
        "fixed_ratios": kept_ratios(search.space),
        "outside": {"original": list(outside_search(search, {}))},
        "converged": front.converged,
        "reason": front.reason,
        "evaluations": front.evaluations,
        "exact_difference": front.difference if math.isfinite(front.difference) else None,
    }


def front_table(problem: Problem, trade_off: TradeOff, front: Front) -> str:
    """Both goals of each design and what they are of the original's; the rates; why it ended."""
    original = _original(trade_off)
    goals = [
        ["original", *(text for value in original for text in (significant(value), ""))],
        *(
            [
                f"design {number}",
                *(
                    text
                    for value, base in zip(design.values, original, strict=True)
                    for text in (significant(value), percent_change(value, base))
                ),
            ]
            for number, design in enumerate(front.designs, 1)
        ),
    ]
    header = ["", *(text for name in front.names for text in (name, ""))]
    return "\n\n".join(
        [
            table(header, goals),
            _rates_table(problem, trade_off, front),
            *_places_table(trade_off, front),
            _ending(problem, trade_off, front),
        ]
    )


def front_csv(problem: Problem, trade_off: TradeOff, front: Front) -> str:
    """A row for each design: goals, the rates of groups that may change and places, with units."""
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    columns, placed = _columns(problem, trade_off, front), _places(trade_off, front)
    names = [f"{group} {spoken(field)}, {spoken_unit(field)}" for group, field, _ in columns]
    writer.writerow(["design", *front.names, *names, *(name for name, *_ in placed)])
    for i, design in enumerate(front.designs):
        rates = (values[i] for *_, values in columns)
        writer.writerow([i + 1, *design.values, *rates, *(row[i + 1] for row in placed)])
    return text.getvalue()


def _original(trade_off: TradeOff) -> list[float]:
    """Both goals with the vehicle's own rates."""
    return [search.goal.value({}) for search in trade_off.searches]


def _columns(problem: Problem, trade_off: TradeOff, front: Front) -> list[tuple[str, str, list[float]]]:
    """The group, the field and the values in each design, in written units, of rates that are told."""
    columns, vehicle = [], trade_off.searches[0].space.vehicle
    for name in (group.group for group in problem.groups):
        rates = [design.rates[name] for design in front.designs]
        for field in listed_fields(vehicle.mount_group(name), *rates):
            columns.append((name, field, [spoken_value(each, field) for each in rates]))
    return columns


def _rates_table(problem: Problem, trade_off: TradeOff, front: Front) -> str:
    rows = [
        [f"{group} {with_unit(field)}", *map(significant, values)]
        for group, field, values in _columns(problem, trade_off, front)
    ]
    return table(["rates, N/mm", *(str(i + 1) for i in range(len(front.designs)))], rows)


def _places(trade_off: TradeOff, front: Front) -> list[list[str]]:
    """A row for each place that was to choose: its name, then where mounts are in each design."""
    return place_rows(trade_off.searches[0].space, *(design.placements for design in front.designs))


def _places_table(trade_off: TradeOff, front: Front) -> list[str]:
    rows = _places(trade_off, front)
    header = ["places", *(str(i + 1) for i in range(len(front.designs)))]
    return [table(header, rows)] if rows else []


def _ending(problem: Problem, trade_off: TradeOff, front: Front) -> str:
    search = trade_off.searches[0]
    impossible = [d.verification.impossible for d in front.designs if d.verification]
    why = next(filter(None, impossible), "")
    exactness = (
        f"the model as given cannot be solved from scratch for all: {why}"
        if why
        else f"{solved_from_scratch('goals', front.difference)} at most"
    )
    worst = most_truncated(front.designs)
    if worst is not None and is_large(worst[1]):
        exactness += "\n" + at_rates(f"the rates of design {worst[0]}", worst[1])
    lines = [
        f"goals: {objective_words(problem)}",
        *space_lines(search.space, {"original": outside_search(search, {})}),
        f"{front.reason} after {front.evaluations} evaluations\n\n{exactness}",
    ]
    return "\n".join(lines)
