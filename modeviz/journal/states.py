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
    what: Change | str
    """A change that it accepted, or how it is looked at."""

    @property
    def state(self) -> str:
        """The session's state then."""
        return self.what.state if isinstance(self.what, Change) else self.what

    def __call__(self, connection: Connection) -> None:
        """Writes it."""
        if isinstance(self.what, Change):
            stored.record(connection, self.session, self.what, self.at)
        else:
            stored.look(connection, self.session, self.what, self.at)


def look_key(session: SessionId) -> Hashable:
    """Return by what a look is overtaken by the next of its session."""
    return "look", session


def fewer(writes: Sequence[Stated]) -> Sequence[tuple[Hashable, Stated]]:
    """Return fewer writes that come to the same, with their keys, see `compacted`.

    Args:
        writes: of one session, the first one first.
    """
    newest = writes[-1]
    times = {each.what.after: each.at for each in writes if isinstance(each.what, Change)}
    kept = compacted([each.what for each in writes if isinstance(each.what, Change)])
    changes = [Stated(newest.session, times[change.after], change) for change in kept]
    look = Stated(newest.session, newest.at, newest.state)
    return [*((None, each) for each in changes), (look_key(newest.session), look)]
