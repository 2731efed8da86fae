"""What is found out about an answer, bit by bit, by one session or by several that have the same."""

import threading
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from modeviz.analysis.exact_check import check_exactly
from modeviz.analysis.results import Results
from modeviz.analysis.sensitivity import sensitivity
from modeviz.errors import ModevizError
from modeviz.viewer.session.findings import Findings

GIVEN_UP = "this went wrong, by our mistake"


class Inquiry:
    """Looks into an answer: what its rates do, how exact it is, how far its bodies are believed.

    Any thread may take the next step; the steps are done once, whoever takes them.
    """

    def __init__(self, now: Results) -> None:
        """Knows nothing yet of an answer."""
        self._findings = Findings(now)
        self._lock = threading.Lock()
        self._steps = self._look()

    @property
    def findings(self) -> Findings:
        """What is known by now."""
        return self._findings

    def advance(self) -> None:
        """Finds out a bit more, if there is more to find out.

        Raises:
            Exception: our mistake; nothing more is found out then.
        """
        with self._lock:
            if self._findings.is_complete:
                return
            try:
                next(self._steps, None)
            except ModevizError as error:
                self.give_up(str(error))
            except Exception:
                self.give_up(GIVEN_UP)
                raise

    def give_up(self, problem: str) -> None:
        """Looks no further, also where a step hangs.

        Args:
            problem: why.
        """
        self._know(problem=problem)

    def _look(self) -> Iterator[None]:
        now = self._findings.now
        self._know(sensitivity=sensitivity(now.prepared, now))
        yield
        for check in check_exactly(now):
            self._know(check=check)
            yield
        self._know(components=now.components)

    def _know(self, **news: Any) -> None:
        if not self._findings.problem:
            self._findings = replace(self._findings, **news)
