"""All long work beside one tuning session."""

from collections.abc import Mapping
from dataclasses import dataclass

from modeviz.journal.runs import RunKind
from modeviz.viewer.tasks.front_task import FrontTask
from modeviz.viewer.tasks.run_recorder import Task
from modeviz.viewer.tasks.scatter_task import ScatterTask
from modeviz.viewer.tasks.search_task import SearchTask


@dataclass(frozen=True, eq=False)
class Tasks:
    """What computes beside a session, one job of each at a time."""

    search: SearchTask
    front: FrontTask
    scatter: ScatterTask

    @property
    def by_kind(self) -> Mapping[RunKind, Task]:
        """Each by what a study file calls its runs."""
        return {"search": self.search, "front": self.front, "scatter": self.scatter}

    @property
    def are_busy(self) -> bool:
        """Whether any is at work, which nobody need look at."""
        jobs = (self.search.job, self.front.job, self.scatter.job)
        return any(job is not None and job.is_running for job in jobs)

    def close(self) -> None:
        """Ends what is running; a search is waited for, as it gives what it has found."""
        self.search.close()
        self.front.cancel()
        self.scatter.cancel()
