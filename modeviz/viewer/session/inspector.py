"""Finds out, while nothing changes, what the rates of an answer do and how exact it is."""

import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial

from modeviz.analysis.results import Results
from modeviz.errors import ModevizError
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.findings import Findings
from modeviz.viewer.session.followed_mode import DETAILS_EVERY
from modeviz.viewer.session.inquiry import GIVEN_UP, STEPS_WITHIN, Inquiry
from modeviz.viewer.session.shared import Shared
from modeviz.viewer.session.state import State
from modeviz.viewer.session.worker import StuckError, Worker

REST = 0.3
"""s without a change after which an answer is checked: longer than the pauses within a drag."""

TELL_EVERY = 0.5
"""s between two words on how far a check is."""


class Inspector:
    """Looks into the newest answer in a thread of its own, as long as it is current.

    Step by step, each when the sessions with which it shares the processors wait for no answer.
    """

    def __init__(
        self,
        shared: Shared,
        rebase: Callable[[State], None],
        is_current: Callable[[Solved], bool],
        found: Callable[[bool], None],
        fail: Callable[[Exception], None],
        patience: float = STEPS_WITHIN,
    ) -> None:
        """Looks into nothing yet.

        Args:
            shared: what the session has in common with others.
            rebase: makes answers near a state cheap.
            is_current: whether an answer is still to what is asked for.
            found: told that there is more to be told of the answer, and whether all of it is to be
                drawn.
            fail: tells of our mistakes.
            patience: s that a step may take, and the wait for it.
        """
        self._shared, self._rebase, self._is_current = shared, rebase, is_current
        self._found, self._fail = found, fail
        self._lock = threading.Lock()
        self._inquiry: Inquiry | None = None
        self._is_done = False
        """Whether there is no more to do about the newest answer."""
        self._problem = ""
        """Why this session looks no further into it, if so; others may."""
        self._told_at = 0.0
        self._worker: Worker[Solved] = Worker(self._look_into, fail, patience, self._leave)

    def findings(self, now: Results) -> Findings:
        """Return what is known of results; those of others are forgotten."""
        with self._lock:
            if self._inquiry is None or self._inquiry.findings.now is not now:
                self._inquiry = self._shared.beginnings.inquiry(now)
                self._is_done, self._problem = False, ""
            return self._known(self._inquiry)

    def submit(self, solved: Solved) -> None:
        """Has an answer looked into, unless all is known of it and done."""
        is_known = self.findings(solved.now).is_complete and self._is_done
        if not (is_known and solved.is_detailed):
            self._worker.submit(solved)

    def wait(self, timeout: float) -> bool:
        """Waits until there is nothing to look into; whether that came within `timeout` s."""
        return self._worker.wait(timeout)

    def close(self) -> None:
        """Ends the thread."""
        self._worker.close()

    def _look_into(self, solved: Solved) -> None:
        """Once nothing changes: shows details, makes the next drag cheap, checks bit by bit."""
        inquiry = self._inquiry_into(solved)
        if inquiry is None or not self._rests(solved, DETAILS_EVERY):
            return
        if not solved.is_detailed:
            self._found(True)
        is_known = self._known(inquiry).is_complete and self._is_done
        if is_known or not self._rests(solved, REST):
            return
        try:
            self._find_out(solved, inquiry)
        except Exception as error:
            self._give_up(solved, error)

    def _leave(self, solved: Solved, error: StuckError, is_left: bool) -> None:
        self._give_up(solved, error)

    def _give_up(self, solved: Solved, error: Exception) -> None:
        """Tells of our mistake, and looks no further into what it happened with; others may."""
        is_newest = self._inquiry_into(solved) is not None
        if is_newest:
            self._is_done, self._problem = True, GIVEN_UP
        try:
            self._fail(error)
        finally:
            if is_newest:
                self._found(False)

    def _find_out(self, solved: Solved, inquiry: Inquiry) -> None:
        """Learns what there is to learn of an answer, as long as it is current.

        What its rates do comes first; then answers near it are made cheap.
        """
        told = self._advance(solved, inquiry, solved.findings)
        with suppress(ModevizError):
            self._in_turn(solved, partial(self._rebase, solved.state))
        while self._is_wanted(solved) and not inquiry.findings.is_complete:
            told = self._advance(solved, inquiry, told)
        if self._is_wanted(solved):
            self._is_done = True

    def _advance(self, solved: Solved, inquiry: Inquiry, told: Findings) -> Findings:
        """Finds out more, and tells it unless little of it is new; returns what is told by then."""
        self._in_turn(solved, inquiry.advance)
        known = inquiry.findings
        is_due = known.is_complete or time.perf_counter() - self._told_at > TELL_EVERY
        if known is told or not (is_due or known.sensitivity is not told.sensitivity):
            return told
        self._told_at = time.perf_counter()
        self._found(False)
        return known

    def _in_turn(self, solved: Solved, step: Callable[[], None]) -> None:
        """Does a step once nobody waits for an answer, if it is still wanted then."""
        self._worker.sign()
        with self._shared.precedence.step(partial(self._is_wanted, solved)) as is_wanted:
            if is_wanted:
                step()

    def _is_wanted(self, solved: Solved) -> bool:
        """Whether the calling thread, unless it was left behind, is to look further into an answer."""
        return self._worker.is_heard and self._is_current(solved)

    def _known(self, inquiry: Inquiry) -> Findings:
        """Return what is known, with why this session finds out no more where others still may."""
        known = inquiry.findings
        return known if known.is_complete else replace(known, problem=self._problem)

    def _inquiry_into(self, solved: Solved) -> Inquiry | None:
        """Return what looks into an answer, if it still is the newest."""
        with self._lock:
            is_newest = self._inquiry is not None and self._inquiry.findings.now is solved.now
            return self._inquiry if is_newest else None

    def _rests(self, solved: Solved, seconds: float) -> bool:
        """Waits; whether nothing else was asked for meanwhile."""
        end = time.perf_counter() + seconds
        while time.perf_counter() < end:
            if not self._is_current(solved):
                return False
            time.sleep(seconds / 10)
        return True
