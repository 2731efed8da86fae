"""What is found out about an answer, bit by bit, by one session or by several that have the same."""

import math
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from modeviz.analysis.exact_check import check_exactly
from modeviz.analysis.results import Results
from modeviz.analysis.sensitivity import sensitivity
from modeviz.errors import ModevizError
from modeviz.viewer.session.findings import Findings

GIVEN_UP = "this went wrong, by our mistake"

STEPS_WITHIN = 300.0
"""s: a step of a check that takes longer hangs."""

WAITS = 0.1
"""s for which a step waits for that of somebody else."""


class Inquiry:
    """Looks into an answer: what its rates do, how exact it is, how far its bodies are believed.

    Any thread may take the next step; the steps are done once, whoever takes them.
    """

    def __init__(self, now: Results, patience: float = STEPS_WITHIN) -> None:
        """Knows nothing yet of an answer.

        Args:
            now: the answer.
            patience: s that a step may take.
        """
        self._findings = Findings(now)
        self._patience = patience
        self._due = math.inf
        """When the step at hand hangs."""
        self._at_step, self._learning = threading.Lock(), threading.Lock()
        self._steps = self._look()

    @property
    def findings(self) -> Findings:
        """What is known by now."""
        return self._findings

    def advance(self) -> None:
        """Finds out a bit more, if there is more to find out and nobody else is at that.

        Once somebody's step hangs, nothing more is found out.

        Raises:
            Exception: our mistake; nothing more is found out then.
        """
        if not self._at_step.acquire(timeout=WAITS):
            if time.monotonic() > self._due:
                self.give_up(GIVEN_UP)
            return
        try:
            self._due = time.monotonic() + self._patience
            self._take_step()
        finally:
            self._due = math.inf
            self._at_step.release()

    def give_up(self, problem: str) -> None:
        """Looks no further, for all who look into the same; nothing happens if all is known.

        A step at hand is not waited for, and what it brings is dropped.

        Args:
            problem: why.
        """
        self._know(problem=problem)

    def _take_step(self) -> None:
        if self._findings.is_complete:
            return
        try:
            next(self._steps, None)
        except ModevizError as error:
            self.give_up(str(error))
        except Exception:
            self.give_up(GIVEN_UP)
            raise

    def _look(self) -> Iterator[None]:
        now = self._findings.now
        self._know(sensitivity=sensitivity(now.prepared, now))
        yield
        for check in check_exactly(now):
            self._know(check=check)
            yield
        self._know(components=now.components)

    def _know(self, **news: Any) -> None:
        with self._learning:
            if not self._findings.is_complete:
                self._findings = replace(self._findings, **news)
