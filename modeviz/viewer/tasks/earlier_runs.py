"""Runs that a study has, as what found them would show them."""

import json
import math
from collections.abc import Callable, Mapping
from typing import TypeVar

import numpy as np

from modeviz.analysis.results import Conditions
from modeviz.dynamics.truncation_gap import TruncationGap
from modeviz.errors import ModevizError
from modeviz.journal.records import UNREADABLE
from modeviz.journal.runs import Run, RunKind
from modeviz.journal.tuning import Pinned, pinned_of_record
from modeviz.optimise.trade_off import ParetoPoint
from modeviz.optimise.verification import Verification
from modeviz.report.records import Record
from modeviz.viewer.session.encoding.plain import value_of
from modeviz.viewer.tasks.background_task import Job, Phase
from modeviz.viewer.tasks.front_task import Designs, Goals
from modeviz.viewer.tasks.scatter_task import HIGH, LOW, Built, ScatterOutcome

Front = Job[Goals, Designs]
Scattering = Job[Built, ScatterOutcome]

ENDED: Mapping[str, Phase] = {"ended": "ended", "cancelled": "cancelled"}


Shown = TypeVar("Shown")


def front_of(run: Run) -> Front | None:
    """Return a front, as `RunRecorder` wrote it; None of another run, or if it has no designs."""
    return _read(run, "front", _front)


def scatter_of(run: Run) -> Scattering | None:
    """Return a scatter with its band; None of another run, or if it was kept without a band."""
    return _read(run, "scatter", _scatter)


def design_of(run: Run) -> Pinned | None:
    """Return the rates and places that a search found; None of another run, or if it found nothing."""
    return _read(run, "search", pinned_of_record)


def _read(run: Run, kind: RunKind, read: Callable[[Record], Shown]) -> Shown | None:
    if run.kind != kind:
        return None
    try:
        return read(json.loads(run.record))
    except (*UNREADABLE, ModevizError):  # there is nothing to show of it
        return None


def _front(record: Record) -> Front:
    first, second = map(str, record["sides"])
    designs = tuple(map(_design, record["designs"]))
    if not designs:
        raise ValueError("found no designs")
    return Job(Goals((first, second)), ENDED[record["phase"]], 1.0, designs)


def _design(record: Record) -> ParetoPoint:
    taken = pinned_of_record(record)
    first, second = map(float, record["values"])
    told = record.get("verification")
    verification = told and _verification(told)
    return ParetoPoint(np.zeros(0), taken.rates, (first, second), verification, taken.placements)


def _verification(record: Record) -> Verification:
    gap = record["gap"]
    return Verification(
        _number(record["value"]),
        _number(record["difference"]),
        np.array(record["frequency_hz"], float),
        bool(record["are_kept"]),
        str(record["impossible"]),
        None if gap is None else value_of(gap, TruncationGap),
        np.array(record["deflection"], float),
    )


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)


def _scatter(record: Record) -> Scattering:
    bands = record["bands"]
    points, f = tuple(map(str, bands["points"])), np.array(bands["frequency_hz"], float)
    percentiles = np.array([bands[LOW], bands[HIGH]], float)
    if percentiles.shape != (2, len(f), len(points), 3):
        raise ValueError("found other numbers of frequencies, points or directions than are drawn")
    rates = pinned_of_record(record).rates
    built = Built(rates, Conditions(str(record["road"]), float(record["speed_m_per_s"])))
    return Job(built, ENDED[record["phase"]], 1.0, ScatterOutcome(record, f, points, percentiles))
