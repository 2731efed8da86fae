"""Runs that a study has, as what found them would show them."""

import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from modeviz.analysis.results import Conditions
from modeviz.dynamics.truncation_gap import TruncationGap
from modeviz.errors import ModevizError
from modeviz.journal.records import UNREADABLE
from modeviz.journal.runs import Run
from modeviz.journal.tuning import Pinned, pinned_of_record
from modeviz.optimise.trade_off import ParetoPoint
from modeviz.optimise.verification import Verification
from modeviz.viewer.session.encoding.plain import value_of
from modeviz.viewer.tasks.background_task import Job, Phase
from modeviz.viewer.tasks.front_task import Designs, Goals
from modeviz.viewer.tasks.scatter_task import HIGH, LOW, Built, ScatterOutcome

Front = Job[Goals, Designs]
Scattering = Job[Built, ScatterOutcome]

ENDED: Mapping[str, Phase] = {"ended": "ended", "cancelled": "cancelled"}


def found_of(run: Run) -> Front | Scattering | Pinned | None:
    """Return a front, a scatter with its band, or the design of a search, as `RunRecorder` wrote it.

    None of a run that found nothing, or of which an earlier modeviz kept too little to show it.
    """
    try:
        record: Mapping[str, Any] = json.loads(run.record)
        match run.kind:
            case "front":
                return _front(record) if record["designs"] else None
            case "scatter":
                return _scatter(record) if "bands" in record else None
            case "search":
                return pinned_of_record(record) if "value" in record else None
    except (*UNREADABLE, ModevizError):
        return None


def _front(record: Mapping[str, Any]) -> Front:
    first, second = map(str, record["sides"])
    designs = tuple(map(_design, record["designs"]))
    return Job(Goals((first, second)), ENDED[record["phase"]], 1.0, designs)


def _design(record: Mapping[str, Any]) -> ParetoPoint:
    taken = pinned_of_record(record)
    first, second = map(float, record["values"])
    told = record.get("verification")
    verification = told and _verification(told)
    return ParetoPoint(np.zeros(0), taken.rates, (first, second), verification, taken.placements)


def _verification(record: Mapping[str, Any]) -> Verification:
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


def _scatter(record: Mapping[str, Any]) -> Scattering:
    bands = record["bands"]
    points, f = tuple(map(str, bands["points"])), np.array(bands["frequency_hz"], float)
    percentiles = np.array([bands[LOW], bands[HIGH]], float)
    if percentiles.shape != (2, len(f), len(points), 3):
        raise ValueError("found other numbers of frequencies, points or directions than are drawn")
    rates = pinned_of_record(record).rates
    built = Built(rates, Conditions(str(record["road"]), float(record["speed_m_per_s"])))
    return Job(built, ENDED[record["phase"]], 1.0, ScatterOutcome(record, f, points, percentiles))
