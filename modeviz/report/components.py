"""Words for what the truncation of a vehicle's components does."""

import math
from dataclasses import asdict

from modeviz.analysis.modal_results import ModalResults
from modeviz.dynamics.component_trust import ComponentTrust

LEAST_REACH = 1.5
"""A body whose modes end below this times the band may well lack some that matter in it."""

LARGE = 0.01
"""A frequency that a few modes more or less change by more than this part of it is none to believe."""

LEAST_SAID = 1e-5
"""Smaller changes, parts of a frequency, are said to be smaller."""


def is_doubtful(trust: ComponentTrust, top_hz: float) -> bool:
    """Whether a body ought to have more modes."""
    return bool(trust.n_left_out) and (trust.change > LARGE or trust.highest_hz < LEAST_REACH * top_hz)


def believed(results: ModalResults) -> tuple[str, ...]:
    """For each flexible body how high its modes reach, and what the last do with these rates."""
    top_hz = results.prepared.basis.top_hz
    return tuple(_words(trust, top_hz) for trust in results.components)


def component_record(trust: ComponentTrust) -> dict[str, str | float | None]:
    """The fields of a component's trust as JSON has them, a change that is infinite as null."""
    return asdict(trust) | {"change": trust.change if math.isfinite(trust.change) else None}


def change_words(trust: ComponentTrust) -> str:
    """Words for what leaving out the last fifth of a body's modes does."""
    if math.isinf(trust.change):
        return "nothing moves"
    if trust.change < LEAST_SAID:
        return f"no frequency changes by {100 * LEAST_SAID:g} %"
    return f"frequencies rise by up to {100 * trust.change:.2g} % (at {trust.at_hz:.2f} Hz)"


def _words(trust: ComponentTrust, top_hz: float) -> str:
    residuals = f"{trust.n_residuals or 'no'} residual vectors"
    reach = f"modes up to {trust.highest_hz:.3g} Hz, {trust.highest_hz / top_hz:.2g} times the band"
    if not trust.n_left_out:
        return f"{trust.body}: rigid modes only, {residuals}"
    modes = "mode" if trust.n_left_out == 1 else f"{trust.n_left_out} modes"
    return f"{trust.body}: {reach}, {residuals}; without its last {modes} {change_words(trust)}" + (
        "; it needs more modes" if is_doubtful(trust, top_hz) else ""
    )
