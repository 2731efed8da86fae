"""Where a search is and what came of it, as page text."""

from html import escape

import numpy as np

from modeviz.optimise.active_limits import ActiveConstraint
from modeviz.optimise.evaluator import CANCELLED, CONVERGED, OUT_OF_BUDGET
from modeviz.optimise.run import Optimum
from modeviz.report.space import outside_words
from modeviz.report.truncation import at_rates, is_large
from modeviz.text.wording import sentence_case, signed, significant
from modeviz.viewer.page.widgets.html import change, heading, row, span, table
from modeviz.viewer.panels.status import ALARMING, percent
from modeviz.viewer.tasks.search_task import SearchStatus

LEAST_GAIN = 5e-4
"""Of the goal: what gains less is not worth a word."""

PERCENTILE = "95th percentile"

RUNNING = {"searching": "Searching", "paused": "Paused", "checking": "Checking"}
ENDINGS = {
    CONVERGED: "Converged",
    CANCELLED: "Cancelled",
    OUT_OF_BUDGET: "Out of budget",
}


def where(look: SearchStatus) -> str:
    """A line on how far it is."""
    if look.stage == "preparing":
        return heading("Preparing")
    if look.stage == "failed":
        return heading("Failed") + span(escape(look.failure), "bad")
    progress = look.progress
    if progress is None:
        begun = PERCENTILE if look.is_robust else "choosing starts"
        return heading(_word(look), begun if look.is_running else "nothing found yet")
    n = f"{progress.evaluations:,}".replace(",", "\N{THIN SPACE}")
    which = PERCENTILE if look.is_robust else f"start {progress.start} of {progress.n_starts}"
    noun = "evaluation" if progress.evaluations == 1 else "evaluations"
    return heading(_word(look), f"{which}, {n} {noun}")


def figures(look: SearchStatus) -> str:
    """The goal of the best design, and of those it is compared with."""
    if look.progress is None:
        return ""
    best = look.progress.value
    cells = [("Best", best, change(best, look.original)), ("Original", look.original, "")]
    if np.isfinite(look.reference):
        name, value = look.problem.reference, look.reference
        cells.append((sentence_case(name), value, change(value, look.original)))
    parts = (
        f"<div><span>{escape(label)}</span><b>{significant(value)}</b>{delta}</div>"
        for label, value, delta in cells
    )
    outside = [outside_words(sentence_case(name), why) for name, why in look.outside.items()]
    notes = "".join(f"<div>{span(escape(text), 'dim')}</div>" for text in outside if text)
    return f'<div class="figures goals">{"".join(parts)}</div>{notes}'


def exactness(optimum: Optimum) -> str:
    """Return the verdict of the full model as given on it."""
    found = optimum.verification
    if found.impossible:
        return span(f"Not checked: {escape(found.impossible)}", "bad")
    if not found.are_kept:
        return span("Solved from scratch, the model as given has a mode out of its band.", "bad")
    text = (
        f"Solved from scratch, the model as given has the same goal within {percent(found.difference)}."
    )
    return span(text, "bad" if 100 * found.difference > ALARMING else "dim")


def truncation(optimum: Optimum) -> str:
    """Return how much too high frequencies are at its rates, if by enough for a word."""
    gap = optimum.verification.gap
    return span(escape(at_rates("these rates", gap)), "bad") if gap and is_large(gap) else ""


def limits(optimum: Optimum) -> str:
    """The limits that the design sits on, and what they cost."""
    worth = [c for c in optimum.active if c.gain >= LEAST_GAIN]
    if not worth:
        return span("No limit holds it back.", "dim")
    rows = [row([escape(c.name), _gain(c)]) for c in worth]
    quiet = len(optimum.active) - len(worth)
    more = span(f"{quiet} more limits are met and cost nothing.", "dim") if quiet else ""
    return f'<div class="limits">{table(("Held back by", "10 % wider gains"), rows)}</div>{more}'


def _word(look: SearchStatus) -> str:
    if look.found is not None:
        reason = look.found.reason
        return ENDINGS.get(reason, escape(sentence_case(reason)))
    return RUNNING.get(look.stage, "Cancelled")


def _gain(constraint: ActiveConstraint) -> str:
    return signed(-100 * constraint.gain, 1, " %")
