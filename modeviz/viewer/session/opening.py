"""With what a session opens: a state that somebody left or sent, and what there was before it."""

from dataclasses import dataclass, field

from modeviz.journal.runs import Run
from modeviz.viewer.session.history import Step
from modeviz.viewer.session.state import State
from modeviz.viewer.session.view import Animation, CameraPose


@dataclass(frozen=True)
class Opening:
    """A session as it was left, or as a link shows it."""

    state: State
    past: tuple[Step, ...] = ()
    """What can be undone, the next one last."""
    future: tuple[Step, ...] = ()
    """What can be redone, the next one last."""
    animation: Animation = field(default_factory=Animation)
    camera: CameraPose | None = None
    """Of pages to come; None: the usual one."""
    title: str = ""
    """What its owner calls the session."""
    runs: tuple[Run, ...] = ()
    """What was computed at length before, the first one first."""
    is_unread: bool = False
    """Whether there is a record of the session that cannot be read, and is to be left as it is."""
    remarks: tuple[str, ...] = ()
    """On what is other than it was, sentences without their stops."""
