"""What is known of an answer beyond it, found out while nothing changes."""

from dataclasses import dataclass

from modeviz.analysis.exact_check import Check
from modeviz.analysis.results import Results
from modeviz.analysis.sensitivity import Sensitivity
from modeviz.dynamics.component_trust import ComponentTrust


@dataclass(frozen=True, eq=False)
class Findings:
    """The findings on an answer."""

    now: Results
    sensitivity: Sensitivity | None = None
    """What ten percent of each rate do, once that is known."""
    check: Check | None = None
    """How far `now` is from the exact answer, as far as that is known."""
    components: tuple[ComponentTrust, ...] | None = None
    """How far the bodies are believed with the rates of `now`, once that is known."""
    problem: str = ""
    """Why no more will be known, if so."""

    @property
    def is_complete(self) -> bool:
        """Whether there is no more to find out."""
        is_checked = self.check is not None and self.check.is_complete
        return bool(self.problem) or (is_checked and self.components is not None)
