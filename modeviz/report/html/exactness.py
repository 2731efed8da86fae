"""The report's section on how exact it is."""

from html import escape

import numpy as np

from modeviz.analysis.exact_check import Check
from modeviz.report.comparison import Comparison
from modeviz.report.components import believed
from modeviz.report.tables import health
from modeviz.report.truncation import truncation_doubts
from modeviz.text.markup import section, title
from modeviz.text.wording import scientific


def exactness(comparison: Comparison, check: Check | None) -> str:
    """The section on how far the numbers are from those of the full model."""
    sets = zip(comparison.names, (comparison.base, comparison.now), strict=True)
    items = [f"{title(name)}: {health(results)}." for name, results in sets]
    if check is not None:
        items.append(_checked(check, escape(comparison.names[1])))
    rates = f"With the rates of {escape(comparison.names[1])}"
    items += [f"{rates}, {escape(words)}." for words in believed(comparison.now)]
    doubts = truncation_doubts(comparison.now.vehicle)
    items += [f"{rates}, {escape(doubt)}." for doubt in doubts]
    return section("How exact this is", "<ul>", *(f"<li>{item}</li>" for item in items), "</ul>")


def _checked(check: Check, name: str) -> str:
    if not np.isfinite(check.frequency_error):
        return f"With the rates of {name} the model as given has another number of modes."
    text = (
        f"Against the model as given, solved from scratch with the rates of {name}: natural "
        f"frequencies differ by {scientific(check.frequency_error)} at most, relative"
    )
    if check.n_lines:
        text += (
            f", spectra by {scientific(check.psd_error)} of the largest of each, at "
            f"{check.n_lines} of {check.n_freqs} frequencies"
        )
    return f"{text}. {escape(check.impossible)}".strip()
