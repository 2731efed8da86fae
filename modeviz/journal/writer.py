"""The one thread that writes a study: what cannot be written stays in memory until it can."""

import logging
import sqlite3
import threading
import time
from collections.abc import Callable, Hashable, Sequence
from pathlib import Path
from sqlite3 import Connection

from modeviz.errors import reason
from modeviz.journal.opening import open_to_write
from modeviz.journal.waiting import Queue, Rework, Waiting, Write

MOST_AT_ONCE = 100
"""Writes in one transaction: more would keep others who write waiting."""

RETRY = 2.0
"""s between tries while nothing can be written."""

log = logging.getLogger(__name__)


class Writer:
    """Takes writes from any thread and commits them in their order.

    A write that has the key of one that waits takes its place, at the end: of looks only the newest
    counts.
    """

    def __init__(self, path: Path, tell: Callable[[str], None]) -> None:
        """Starts the thread.

        Args:
            path: of the study file, which is there.
            tell: told why nothing can be written, and "" once all is written again; it may not fail.

        Raises:
            sqlite3.Error: it cannot be written.
        """
        self._path, self._tell = path, tell
        self._changed = threading.Condition()
        self._waiting = Queue()
        self._is_closed = False
        self._why = self._since = self._told = ""
        self._connection: Connection | None = open_to_write(path)
        self._status = path.stat()
        self._thread = threading.Thread(target=self._run, name="study writer", daemon=True)
        self._thread.start()

    @property
    def trouble(self) -> str:
        """Since when and why nothing can be written, and what is lost by it; "" while it can."""
        if not self._why:
            return ""
        lost = ", ".join(f"{n} {what}{'s' * (n != 1)}" for what, n in self._waiting.lost.items())
        return f"not saved since {self._since}: {self._why}{f'; lost: {lost}' if lost else ''}"

    @property
    def n_waiting(self) -> int:
        """How many writes are in memory alone."""
        with self._changed:
            return len(self._waiting)

    def holds(self, owner: str) -> bool:
        """Whether something of an owner is in memory alone."""
        with self._changed:
            return self._waiting.holds(owner)

    def put(
        self, write: Write, owner: str = "", key: Hashable = None, what: str = "", n_bytes: int = 0
    ) -> None:
        """Asks for a write; returns at once.

        Args:
            write: what to do with a connection that is in a transaction.
            owner: whose it is, see `holds`.
            key: of what is overtaken by the next of that key; None: nothing overtakes it.
            what: something large is called, such as "picture", which is lost while nothing can be
                written and more wait than memory is to hold; "" for what is never lost.
            n_bytes: that it takes in memory.
        """
        with self._changed:
            self._waiting.put(Waiting(write, owner, what, n_bytes), key)
            if what and self._why:
                self._waiting.lose_oldest()
            self._changed.notify_all()

    def rework(self, owner: str, kind: type, rework: Rework) -> None:
        """Puts others in the place of what waits; see `Queue.rework`."""
        with self._changed:
            self._waiting.rework(owner, kind, rework)

    def flush(self, timeout: float) -> bool:
        """Waits until all is on the disk; whether that came within `timeout` s.

        While nothing can be written it is tried once more at once.
        """
        with self._changed:
            self._changed.notify_all()
            return self._changed.wait_for(lambda: self._waiting.is_done, timeout)

    def close(self, timeout: float) -> bool:
        """Ends the thread once all is on the disk; whether that came within `timeout` s."""
        is_saved = self.flush(timeout)
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()
        self._thread.join(timeout)
        return is_saved

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._waiting or self._is_closed)
                if self._is_closed:
                    break
                writes = self._waiting.take(MOST_AT_ONCE)
            self._settle(self._try(writes))
        self._disconnect()

    def _settle(self, why: str) -> None:
        """Forgets what is written, tells what is new, and waits where nothing can be."""
        with self._changed:
            self._waiting.settle(not why)
            if why and not self._why:
                self._since = time.strftime("%H:%M")
            self._why = why
            if not why:
                self._waiting.lost.clear()
            trouble = self.trouble
            news, self._told = trouble != self._told, trouble
            self._changed.notify_all()
        if news:
            self._tell(trouble)
        if why:
            with self._changed:
                if not self._is_closed:
                    self._changed.wait(RETRY)

    def _try(self, writes: Sequence[Write]) -> str:
        """Commits some writes; returns why not, or ""."""
        try:
            self._check_there()
            if self._connection is None:
                self._connection = open_to_write(self._path)
            _commit(self._connection, writes)
        except (sqlite3.Error, OSError, MemoryError) as error:
            self._disconnect()
            return _words(error)
        return ""

    def _check_there(self) -> None:
        """Raises OSError if the file was taken away: what is written to it then is nowhere."""
        now = self._path.stat()
        if (now.st_dev, now.st_ino) != (self._status.st_dev, self._status.st_ino):
            raise FileNotFoundError(0, "another file is in the place of the study")

    def _disconnect(self) -> None:
        if self._connection is not None:
            try:
                self._connection.close()
            except sqlite3.Error as error:
                log.warning("closing %s: %s", self._path.name, error)
            self._connection = None


def _commit(connection: Connection, writes: Sequence[Write]) -> None:
    """Does some writes in one transaction; one that is our mistake is left out, and logged."""
    connection.execute("BEGIN IMMEDIATE")
    for write in writes:
        connection.execute("SAVEPOINT one")
        try:
            write(connection)
        except Exception as error:
            if isinstance(error, sqlite3.OperationalError | MemoryError) or (
                type(error) is sqlite3.DatabaseError  # a file that is damaged
            ):
                raise
            log.exception("a write to the study was left out")
            connection.execute("ROLLBACK TO one")
        connection.execute("RELEASE one")
    connection.execute("COMMIT")


def _words(error: Exception) -> str:
    said = str(error)
    if "disk is full" in said or getattr(error, "errno", 0) == 28:
        return "the disk is full"
    return (
        "the study file is gone"
        if isinstance(error, FileNotFoundError) and error.errno
        else reason(error)
    )
