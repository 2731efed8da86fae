"""What can be read of a study, whether it is being written or lies on a shelf."""

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from sqlite3 import Connection
from typing import Self

from modeviz.errors import ModevizError, placed, reason
from modeviz.journal import history as past
from modeviz.journal import notes as remarks
from modeviz.journal import pictures as images
from modeviz.journal import runs as computed
from modeviz.journal import sessions as stored
from modeviz.journal.opening import check_is_study, connect_to_read
from modeviz.journal.sessions import SessionId, SessionLine, StoredSession
from modeviz.report.notes import Note

UNREADABLE = (KeyError, TypeError, ValueError, AttributeError, RecursionError)
"""What contents raise that are whole, and say something else than a study's do."""


@dataclass(frozen=True)
class Study:
    """What a study as a whole is of."""

    vehicle_name: str
    begun: float
    """s since 1970."""


class Records:
    """Reads a study; every method raises ModevizError where that cannot be read, or is damaged."""

    def __init__(self, path: Path, connect: Callable[[], Connection]) -> None:
        """Reads what connections to a file see."""
        self.path: Path = path
        self._connect = connect

    @classmethod
    def of_file(cls, path: Path) -> Self:
        """Return what can be read of a file, which may be in use, or where nothing can be written.

        Raises:
            ModevizError: there is none, it is no study, damaged, or of a later modeviz.
        """
        check_is_study(path)
        return cls(path, lambda: connect_to_read(path))

    def study(self) -> Study:
        """Return of what the study is."""
        with self._reading() as connection:
            return Study(*connection.execute("SELECT name, begun FROM study").fetchone())

    def sessions(self) -> tuple[SessionLine, ...]:
        """Return every session, the one that was begun first first."""
        with self._reading() as connection:
            return stored.sessions(connection)

    def restore(self, session: SessionId) -> StoredSession | None:
        """Return a session as it was left; None where there is none."""
        with self._reading() as connection:
            return stored.restore(connection, session)

    def reviews(self) -> dict[str, SessionId]:
        """Return the sessions that reviews show which have not ended, by the digests of their keys."""
        with self._reading() as connection:
            return stored.reviews(connection)

    def history(self, session: SessionId | None = None) -> tuple[past.Entry, ...]:
        """Return what happened, in its order: all of it, or what did in one session."""
        with self._reading() as connection:
            return past.history(connection, _number(connection, session))

    def notes(self, session: SessionId | None = None) -> tuple[Note, ...]:
        """Return the notes for all and those of a session, or of every one; the first one first."""
        with self._reading() as connection:
            return remarks.notes(connection, _number(connection, session))

    def runs(self, session: SessionId) -> tuple[computed.Run, ...]:
        """Return the runs of a session, the first one first."""
        with self._reading() as connection:
            return computed.runs(connection, stored.known_number(connection, session))

    def pictures(self, session: SessionId) -> tuple[images.PictureLine, ...]:
        """Return the pictures of a session, the first one first."""
        with self._reading() as connection:
            return images.pictures(connection, stored.known_number(connection, session))

    def picture(self, session: SessionId, token: str) -> bytes | None:
        """Return a picture of a session as PNG; None where it has none of that token."""
        with self._reading() as connection:
            return images.picture(connection, stored.known_number(connection, session), token)

    @contextmanager
    def _reading(self) -> Iterator[Connection]:
        """Yields a connection at which one moment of the study is seen."""
        try:
            connection = self._connect()
            try:
                connection.execute("BEGIN")
                yield connection
            finally:
                connection.close()
        except sqlite3.Error as error:
            raise ModevizError(f"{self.path}: cannot be read ({reason(error)})") from None
        except UNREADABLE as error:
            raise ModevizError(f"{self.path}: is damaged: {reason(error)}") from None
        except ModevizError as error:
            raise type(error)(placed(str(self.path), str(error))) from None


def _number(connection: Connection, session: SessionId | None) -> int | None:
    """The number of one session; None for all of them."""
    return None if session is None else stored.known_number(connection, session)
