"""Writes what a session computes at length to a study file: searches, fronts and scatter."""

import json
import math
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Protocol

from modeviz.journal.runs import Run, RunKind
from modeviz.journal.sessions import SessionId
from modeviz.journal.study_file import StudyFile
from modeviz.optimise.trade_off import ParetoPoint
from modeviz.optimise.verification import Verification
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.placement import Placements
from modeviz.viewer.session.encoding.plain import plain_of
from modeviz.viewer.tasks.background_task import Job
from modeviz.viewer.tasks.front_task import Designs, Trade
from modeviz.viewer.tasks.scatter_task import HIGH, LOW, Build, ScatterOutcome
from modeviz.viewer.tasks.search_task import SearchStatus

Record = Mapping[str, Any]
Told = tuple[str, Record]
"""A title, and what was asked and found, as JSON has it."""


class Task(Protocol):
    """Something that computes, one job at a time."""

    def watch(self, watcher: Callable[[Any], None]) -> None:
        """Has somebody given every job when there is something new."""
        ...


@dataclass(frozen=True, eq=False)
class _Begun:
    """A run that goes on."""

    asked: object
    author: str
    at: float


class RunRecorder:
    """Writes every run that ends, however it does, with who began it and how long it took."""

    def __init__(
        self,
        study: StudyFile,
        name: SessionId,
        author: Callable[[], str],
        tasks: Mapping[RunKind, Task],
        tell: Callable[[Run], None],
    ) -> None:
        """Begins.

        Args:
            study: where it is written.
            name: under which the study file knows the session.
            author: says who begins a run, in the thread in which that is done.
            tasks: what computes.
            tell: told of every run that was written, in the thread in which it ended.
        """
        self._study, self._name, self._author, self._tell = study, name, author, tell
        self._lock = threading.Lock()
        self._begun: list[_Begun] = []
        for kind, task in tasks.items():
            task.watch(partial(self._follow, kind))

    def _follow(self, kind: RunKind, job: Job[Any, Any]) -> None:
        with self._lock:
            begun = next((each for each in self._begun if each.asked is job.asked), None)
            if job.is_running and begun is None:
                self._begun.append(_Begun(job.asked, self._author(), time.monotonic()))
            if job.is_running or begun is None:
                return
            self._begun.remove(begun)
        title, record = told(job)
        seconds = time.monotonic() - begun.at
        text = json.dumps({"phase": job.phase, "failure": job.failure, **record})
        run = Run(kind, title, text, begun.author, seconds, time.time())
        self._tell(replace(run, token=self._study.put_run(self._name, run)))


def told(job: Job[Any, Any]) -> Told:
    """Return what there is to tell of a run that has ended."""
    if isinstance(job, SearchStatus):
        title, record = _search(job)
    elif isinstance(job.asked, Trade):
        title, record = _front(job)
    else:
        title, record = _scatter(job)
    ending = {"cancelled": ", cancelled", "failed": f", failed: {job.failure}"}.get(job.phase, "")
    return title + ending, record


def _search(job: SearchStatus) -> Told:
    problem, n_starts = job.asked.problem, job.asked.options.starts
    title = f"{problem.name}, {n_starts} start{'s' if n_starts != 1 else ''}"
    record = {"problem": problem.name, "goal": problem.goal, "starts": n_starts}
    if job.found is None:
        return title, record
    found = {
        "value": job.found.value,
        "evaluations": job.found.evaluations,
        "reason": job.found.reason,
        **_design(job.found.rates, job.found.placements),
    }
    if job.has_begun:
        title, found["original"] = f"{title}: {job.original:.4g} to", job.original
    return f"{title} {job.found.value:.4g}", {**record, **found}


def _front(job: Job[Trade, Designs]) -> Told:
    first, second = job.asked.names
    designs = job.found or ()
    record = {
        "problem": job.asked.problem.name,
        "sides": [first, second],
        "designs": [_of_front(design) for design in designs],
    }
    return f"{first} against {second}: {len(designs)} designs", record


def _scatter(job: Job[Build, ScatterOutcome]) -> Told:
    title = f"{job.asked.options.samples} vehicles on {job.asked.conditions.road}"
    asked = {"samples": job.asked.options.samples, **_design(job.asked.rates, {})}
    return title, {**asked, **(_of_scatter(job.found) if job.found else {})}


def _of_front(design: ParetoPoint) -> Record:
    told = design.verification
    return {
        "values": [*design.values],
        **_design(design.rates, design.placements),
        "verification": told and _verification(told),
    }


def _verification(told: Verification) -> Record:
    """Its fields, None for numbers that are unknown."""
    return {
        "value": told.value if math.isfinite(told.value) else None,
        "difference": told.difference if math.isfinite(told.difference) else None,
        "frequency_hz": told.frequency_hz.tolist(),
        "are_kept": bool(told.are_kept),
        "impossible": told.impossible,
        "gap": plain_of(told.gap),
        "deflection": told.deflection.tolist(),
    }


def _of_scatter(found: ScatterOutcome) -> Record:
    """The quantities of all vehicles, and between what their spectra stay at every point."""
    low, high = (
        [[[_short(value) for value in point] for point in line] for line in band.tolist()]
        for band in found.percentiles
    )
    bands = {"points": [*found.points], "frequency_hz": found.frequency_hz.tolist()}
    return {**found.record, "bands": {**bands, LOW: low, HIGH: high}}


def _short(value: float) -> float:
    """A value to six digits, for a line in a chart."""
    return float(f"{value:.6g}")


def _design(rates: Rates, placements: Placements) -> dict[str, Any]:
    return {"rates": plain_of(rates), "placements": plain_of(placements)}
