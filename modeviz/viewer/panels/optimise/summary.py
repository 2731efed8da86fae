"""An optimisation problem at a glance, as page text."""

from collections.abc import Sequence
from html import escape

import numpy as np

from modeviz.optimise.design_space import DesignSpace
from modeviz.report.optimum import objective_words, tolerance_words
from modeviz.report.space import ratio_words
from modeviz.scatter.tolerance import Tolerance
from modeviz.text.markup import title
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.problem import (
    MOUNTED,
    VARIABLES,
    DeflectionLimit,
    FrequencyWindow,
    Performance,
    Problem,
)

FEW = 4
"""So many frequencies are written out, unless what counts is all between the first and the last."""


def summary(problem: Problem, space: DesignSpace, is_robust: bool) -> str:
    """Return the goal of a problem, and what may change for it."""
    rows = [("Reduce", title(objective_words(problem)))]
    if is_robust:
        rows.append(("", f"95th percentile of parts, {tolerance_words(Tolerance())}"))
    if problem.goal in VARIABLES:
        loads = [_loads(p, most=1 if problem.goal == "peak" else FEW) for p in problem.performance]
        rows += [("On" if i == 0 else "", title(text)) for i, text in enumerate(loads)]
    if problem.goal in MOUNTED:
        targets = [_target(target) for target in problem.mounts or (MountTarget(),)]
        rows += [("On" if i == 0 else "", title(text)) for i, text in enumerate(targets)]
    rows.append(("Free", _free(space)))
    rows += [("Held", _held(window)) for window in problem.windows]
    rows += [("Held", _gives(limit)) for limit in problem.deflections]
    lines = "".join(f'<span class="dim">{key}</span><span>{text}</span>' for key, text in rows)
    return f'<div class="glance">{lines}</div>'


def _loads(performance: Performance, most: int) -> str:
    """As in "road 1 at 6 to 14 Hz: all points, lateral and vertical"; no more frequencies in a list."""
    loads = [*performance.roads, *_counted(performance.wheel_loads, "wheel loads")]
    points = _counted(performance.points, "points") or ["all points"]
    target = f", to {performance.target:g}" if performance.target else ""
    weight = f", weight {performance.weight:g}" if performance.weight != 1 else ""
    frequencies = _frequencies(performance.frequency_hz, most)
    return (
        f"{' and '.join(loads)} at {frequencies}: {', '.join(points)}, "
        f"{' and '.join(performance.directions)}{target}{weight}"
    )


def _target(target: MountTarget) -> str:
    """As in "front and rear, vertical: road 1"."""
    mounts = _counted(target.mounts, "mounts") or ["all mounts"]
    loads = _counted(target.loads, "loads") or ["what usually shakes them"]
    weight = f", weight {target.weight:g}" if target.weight != 1 else ""
    return f"{' and '.join(mounts)}, {', '.join(target.directions)}: {' and '.join(loads)}{weight}"


def _counted(names: Sequence[str], what: str) -> list[str]:
    return list(names) if len(names) < 2 else [f"{len(names)} {what}"]


def _frequencies(frequency_hz: Floats, most: int) -> str:
    if len(frequency_hz) <= most:
        return f"{', '.join(f'{f:.4g}' for f in frequency_hz)} Hz"
    return f"{np.min(frequency_hz):g} to {np.max(frequency_hz):g} Hz"


def _free(space: DesignSpace) -> str:
    n, ratios = space.n_variables, ratio_words(space)
    text = f"{n} number{'s' if n > 1 else ''} to choose, within bounds and ratio limits"
    return escape(f"{text}; ratios stay as they are now: {ratios}" if ratios else text)


def _gives(limit: DeflectionLimit) -> str:
    most = f"{1e3 * limit.most:g} mm in {escape(limit.load_case)}"
    return f"{escape(limit.mount)} {limit.direction} at most {most}"


def _held(window: FrequencyWindow) -> str:
    where = "within" if window.is_inside else "out of"
    if np.isinf(window.high_hz):
        band = f"above {window.low_hz:g} Hz"
    elif window.low_hz == 0:
        band = f"below {window.high_hz:g} Hz"
    else:
        band = f"{where} {window.low_hz:g} to {window.high_hz:g} Hz"
    return f"{title(window.mode)} {band}"
