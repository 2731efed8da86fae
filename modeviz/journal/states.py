"""Writes of a session's state: changes that it accepted, and how it is looked at."""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from sqlite3 import Connection

from modeviz.journal import sessions as stored
from modeviz.journal.changes import Change
from modeviz.journal.compaction import compacted
from modeviz.journal.sessions import SessionId


@dataclass(frozen=True)
class Stated:
    """Writes what becomes of a session's state."""

    session: SessionId
    at: float
    """s since 1970."""


@dataclass(frozen=True)
class Recorded(Stated):
    """Writes a change that a session accepted."""

    change: Change

    def __call__(self, connection: Connection) -> None:
        stored.record(connection, self.session, self.change, self.at)

    @property
    def state(self) -> str:
        """The session's state after it."""
        return self.change.state


@dataclass(frozen=True)
class Looked(Stated):
    """Writes how a session is looked at."""

    state: str

    def __call__(self, connection: Connection) -> None:
        stored.look(connection, self.session, self.state, self.at)


def look_key(session: SessionId) -> Hashable:
    """Return by what a look is overtaken by the next of its session."""
    return "look", session


def fewer(writes: Sequence[Recorded | Looked]) -> Sequence[tuple[Hashable, Recorded | Looked]]:
    """Return fewer writes that come to the same, with their keys, see `compacted`.

    Args:
        writes: of one session, the first one first.
    """
    newest = writes[-1]
    recorded = [each for each in writes if isinstance(each, Recorded)]
    times = {each.change.after: each.at for each in recorded}
    kept = compacted([each.change for each in recorded])
    changes = [Recorded(newest.session, times[change.after], change) for change in kept]
    look = Looked(newest.session, newest.at, newest.state)
    return [*((None, each) for each in changes), (look_key(newest.session), look)]
