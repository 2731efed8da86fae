"""Finds out, while nothing changes, what the rates of an answer do and how exact it is."""

import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from modeviz.analysis.exact_check import check_exactly
from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Results
from modeviz.analysis.sensitivity import sensitivity
from modeviz.errors import ModevizError
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.findings import Findings
from modeviz.viewer.session.followed_mode import DETAILS_EVERY
from modeviz.viewer.session.state import State
from modeviz.viewer.session.worker import StuckError, Worker

REST = 0.3
"""s without a change after which an answer is checked: longer than the pauses within a drag."""

STEPS_WITHIN = 300.0
"""s: a step of a check that takes longer hangs."""

GIVEN_UP = "this went wrong, by our mistake"

TELL_EVERY = 0.5
"""s between two words on how far a check is."""


class Inspector:
    """Looks into the newest answer in a thread of its own, as long as it is current."""

    def __init__(
        self,
        rebase: Callable[[State], Prepared],
        is_current: Callable[[Solved], bool],
        found: Callable[[bool], None],
        fail: Callable[[Exception], None],
        patience: float = STEPS_WITHIN,
    ) -> None:
        """Looks into nothing yet.

        Args:
            rebase: makes answers near a state cheap.
            is_current: whether an answer is still to what is asked for.
            found: told that there are new findings, and whether more than the status changes by them.
            fail: tells of our mistakes.
            patience: s that a step may take.
        """
        self._rebase, self._is_current, self._found, self._fail = rebase, is_current, found, fail
        self._lock = threading.Lock()
        self._findings: Findings | None = None
        self._worker: Worker[Solved] = Worker(self._look_into, fail, patience, self._leave)

    def findings(self, now: Results) -> Findings:
        """Return what is known of results; those of others are forgotten."""
        with self._lock:
            if self._findings is None or self._findings.now is not now:
                self._findings = Findings(now)
            return self._findings

    def submit(self, solved: Solved) -> None:
        """Has an answer looked into, unless all is known of it."""
        if not self.findings(solved.now).is_complete:
            self._worker.submit(solved)

    def wait(self, timeout: float) -> bool:
        """Waits until there is nothing to look into; whether that came within `timeout` s."""
        return self._worker.wait(timeout)

    def close(self) -> None:
        """Ends the thread."""
        self._worker.close()

    def _look_into(self, solved: Solved) -> None:
        """Once nothing changes: shows details, makes the next drag cheap, checks bit by bit."""
        if not self._rests(solved, DETAILS_EVERY) or not self._has_more_to_find(solved.now):
            return
        if not solved.is_detailed:
            self._learn(solved.now)
        if not self._rests(solved, REST):
            return
        self._worker.sign()
        try:
            self._find_out(solved)
        except ModevizError as error:
            self._learn(solved.now, problem=str(error))
        except Exception as error:
            self._give_up(solved, error)

    def _leave(self, solved: Solved, error: StuckError, is_left: bool) -> None:
        self._give_up(solved, error)

    def _give_up(self, solved: Solved, error: Exception) -> None:
        """Tells of our mistake, and looks no further into what it happened with."""
        self._fail(error)
        self._learn(solved.now, problem=GIVEN_UP)

    def _find_out(self, solved: Solved) -> None:
        """Learns what the rates of an answer do, how exact it is, and how far its bodies are believed.

        As long as it is current.
        """
        now, near = solved.now, self._rebase(solved.state)
        self._learn(now, sensitivity=sensitivity(near, now))
        told = 0.0
        for check in check_exactly(now):
            self._worker.sign()
            if not self._is_current(solved):
                return
            if check.is_complete or time.perf_counter() - told > TELL_EVERY:
                told = time.perf_counter()
                self._learn(now, is_to_be_drawn=False, check=check)
        if self._is_current(solved):
            self._learn(now, is_to_be_drawn=False, components=now.components)

    def _learn(self, now: Results, is_to_be_drawn: bool = True, **news: Any) -> None:
        """Keeps and tells what is now known of results, if they are still the newest."""
        with self._lock:
            if self._findings is None or self._findings.now is not now or self._findings.problem:
                return
            self._findings = replace(self._findings, **news)
        self._found(is_to_be_drawn)

    def _has_more_to_find(self, now: Results) -> bool:
        with self._lock:
            known = self._findings
        return known is not None and known.now is now and not known.is_complete

    def _rests(self, solved: Solved, seconds: float) -> bool:
        """Waits; whether nothing else was asked for meanwhile."""
        end = time.perf_counter() + seconds
        while time.perf_counter() < end:
            if not self._is_current(solved):
                return False
            time.sleep(seconds / 10)
        return True
