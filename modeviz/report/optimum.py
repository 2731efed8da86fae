"""Results of an optimisation as plain values for JSON and as a text table."""

import math

from modeviz.optimise.active_limits import RELAXED
from modeviz.optimise.goals import Goal
from modeviz.optimise.outside import kept_ratios, outside_search
from modeviz.optimise.run import Optimum
from modeviz.optimise.search import Search
from modeviz.report.places import place_rows, placements_record
from modeviz.report.rate_fields import listed_fields, with_unit
from modeviz.report.records import Record, rates_record
from modeviz.report.space import space_lines
from modeviz.report.tables import table
from modeviz.report.truncation import gap_doubts, gap_record
from modeviz.scatter.robust import Robust
from modeviz.scatter.tolerance import Tolerance
from modeviz.text.wording import percent_change, scientific, significant
from modeviz.vehicle.mount_rates import Rates, spoken_value
from modeviz.vehicle.problem import UNSHAKEN, GoalKind, Problem

SMALL: dict[GoalKind, str] = {
    "accelerations": "squared accelerations",
    "peak": "largest squared acceleration",
    "rms": "mean squares under random loads",
    "rating": "combined mean square at the driver's point",
    "iso 2631": "square of the ISO 2631-1 total at the driver's point",
    "idle": "mean square at the driver's point while engines idle",
    "forces": "mean squares of mounts' forces",
    "transmissibility": "squared transmissibilities of mounts",
    "purity": "largest impurity of a mode",
    "decoupling": "what is missing to purity, band and gaps",
    "change": "mean square of ln(k/k₀)",
}
"""What becomes small, in people's words."""


def optimum_record(problem: Problem, search: Search, optimum: Optimum) -> Record:
    """The result of an optimisation as plain values for JSON.

    `{"goal", "normalised", "percentile": of the objective over parts that scatter or null, "objective":
    {"original", "found", "paper": of the problem's reference or null}, "rates": see rates_record,
    "placements": of mounts that are not where they were given, see placements_record, "fixed_ratios":
    {group: {"lateral", "fore_aft"}} to the vertical rate, "outside": {"original", "paper"}: why these
    could not be found, [] if they could, "converged", "reason", "evaluations", "active_constraints":
    [{"name", "multiplier", "gain"}], "exact_difference": or null where the full model as given cannot
    be solved exactly enough, "truncation": how much too high frequencies are with these rates, the
    fields of dynamics.truncation_gap.TruncationGap, null if no body lacks residual compliance}`; a gain
    is a part of what was found, from relaxing the limit by 10 %.
    """
    vehicle = search.space.vehicle
    difference = optimum.verification.difference
    original, *paper = compared_outside(problem, search).values()
    return {
        "goal": problem.goal,
        "normalised": problem.is_normalised,
        "percentile": search.goal.percent if isinstance(search.goal, Robust) else None,
        "objective": _objective(problem, search, optimum),
        "rates": rates_record(vehicle.with_rates(optimum.rates)),
        "placements": placements_record(optimum.placements),
        "fixed_ratios": kept_ratios(search.space),
        "outside": {"original": list(original), "paper": [text for why in paper for text in why]},
        "converged": optimum.converged,
        "reason": optimum.reason,
        "evaluations": optimum.evaluations,
        "active_constraints": [
            {"name": c.name, "multiplier": c.multiplier, "gain": c.gain} for c in optimum.active
        ],
        "exact_difference": difference if math.isfinite(difference) else None,
        "truncation": gap_record(optimum.verification.gap),
    }


def optimum_table(problem: Problem, search: Search, optimum: Optimum) -> str:
    """Rates and objective, original, found and of the reference; why it ended; limits it sits on."""
    parts = [
        _rates_table(problem, search, optimum),
        _places_table(search, optimum),
        _ending(problem, search, optimum),
        _exactness(search, optimum),
        "\n".join(optimum_doubts(search, optimum)),
        _limits(optimum),
    ]
    return "\n\n".join(part for part in parts if part)


def optimum_doubts(search: Search, optimum: Optimum) -> list[str]:
    """Sentences on what the truncation of bodies does to frequencies with the rates that were found."""
    gap = optimum.verification.gap
    if gap is None:
        return []
    vehicle = search.space.built(optimum.x)
    return [f"at these rates {doubt}" for doubt in gap_doubts(gap, vehicle)]


def objective_words(problem: Problem) -> str:
    """Words for what becomes small and how it is added up, so that nobody has to guess the sum."""
    what = SMALL[problem.goal]
    if problem.goal in UNSHAKEN:
        return what
    how = "each load case relative to the original" if problem.is_normalised else "plain sum"
    return f"{what}, {how}"


def tolerance_words(tolerance: Tolerance) -> str:
    """Within what parts scatter."""
    rates, loss = 100 * tolerance.rates, 100 * tolerance.loss_factor
    return f"rates within ±{rates:.3g} %, loss factors within ±{loss:.3g} %"


def _objective(problem: Problem, search: Search, optimum: Optimum) -> dict[str, float | None]:
    goal, sets = search.goal, search.space.vehicle.rate_sets
    reference = goal.value(sets[problem.reference]) if problem.reference else None
    return {"original": goal.value({}), "found": optimum.value, "paper": reference}


def _rates_table(problem: Problem, search: Search, optimum: Optimum) -> str:
    """A row for each rate of the problem's groups, and one for the objective."""
    vehicle = search.space.vehicle
    own = vehicle.rates
    others: dict[str, Rates] = {"found": optimum.rates}
    if problem.reference:
        others[problem.reference] = vehicle.all_rates(vehicle.rate_sets[problem.reference])
    rows = []
    for group in problem.groups:
        columns = [rates[group.group] for rates in (own, *others.values())]
        for field in listed_fields(vehicle.mount_group(group.group), *columns):
            values = [spoken_value(rates, field) for rates in columns]
            rows.append([f"{group.group} {with_unit(field)}", *_row(values)])
    values = [v for v in _objective(problem, search, optimum).values() if v is not None]
    rows.append(["objective", *_row(values)])
    return table(["rates, N/mm", "original", *(c for name in others for c in (name, ""))], rows)


def _places_table(search: Search, optimum: Optimum) -> str:
    """A row for each place that was to choose."""
    space = search.space
    rows = place_rows(space, space.places.base, optimum.placements)
    return table(["places", "before", "found"], rows) if rows else ""


def _row(values: list[float]) -> list[str]:
    """The first value, and each other with how much more or less it is."""
    first, *others = values
    return [
        significant(first),
        *(text for v in others for text in (significant(v), percent_change(v, first))),
    ]


def _ending(problem: Problem, search: Search, optimum: Optimum) -> str:
    n = len(optimum.descents)
    noun = "evaluation" if optimum.evaluations == 1 else "evaluations"
    starts = "1 search" if n == 1 else f"{n} searches"
    lines = [
        f"objective: {objective_words(problem)}{_scattered(search.goal)}",
        *space_lines(search.space, compared_outside(problem, search)),
        f"{optimum.reason} after {optimum.evaluations} {noun} in {starts}",
    ]
    return "\n".join(lines)


def compared_outside(problem: Problem, search: Search) -> dict[str, tuple[str, ...]]:
    """The reasons why rates that a search is compared with could not be found, by their name."""
    sets: dict[str, Rates] = {"original": {}}
    if problem.reference:
        sets[problem.reference] = search.space.vehicle.rate_sets[problem.reference]
    return {name: outside_search(search, rates) for name, rates in sets.items()}


def _scattered(goal: Goal) -> str:
    """Over which parts a goal is a percentile, if it is one."""
    if not isinstance(goal, Robust):
        return ""
    return f",\n{goal.percent:g}th percentile with {tolerance_words(goal.tolerance)}"


def _exactness(search: Search, optimum: Optimum) -> str:
    """The found design in the full model as given."""
    check = optimum.verification
    if check.impossible:
        lines = [f"the model as given cannot be solved from scratch: {check.impossible}"]
    else:
        lines = [solved_from_scratch("objective", check.difference)]
    if search.windows is not None:
        pairs = zip(search.windows.windows, check.frequency_hz.tolist(), strict=True)
        lines += [
            f"{window.mode} at {f:.3f} Hz in the model as given"
            + ("" if window.allows(f) else ", where it may not be")
            for window, f in pairs
        ]
    if search.deflections is not None:
        gives = zip(search.deflections.limits, check.deflection.tolist(), strict=True)
        lines += [
            f"{limit.mount} gives {1e3 * abs(d):.3f} mm ({limit.direction}, {limit.load_case})"
            + ("" if limit.allows(d) else ", more than it may")
            for limit, d in gives
        ]
    return "\n".join(lines)


def solved_from_scratch(what: str, difference: float) -> str:
    """How far the full model as given is from what was found."""
    part = scientific(difference)
    return f"solved from scratch, the model as given differs in its {what} by a part of {part}"


def _limits(optimum: Optimum) -> str:
    if not optimum.active:
        return ""
    header = ["limits it sits on", f"{100 * RELAXED:.0f} % wider would gain about", "multiplier"]
    rows = [[c.name, f"{100 * c.gain:.1f} %", f"{c.multiplier:.3g}"] for c in optimum.active]
    return table(header, rows)
