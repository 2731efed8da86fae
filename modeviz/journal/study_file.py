"""A study file that is open: what sessions write to it, and read back."""

import logging
import os
import secrets
import sqlite3
import threading
import time
from collections.abc import Callable, Hashable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from sqlite3 import Connection

from modeviz.errors import ModevizError, reason
from modeviz.journal import notes as remarks
from modeviz.journal import sessions as stored
from modeviz.journal.changes import LONGEST, Change
from modeviz.journal.fingerprint import Fingerprint
from modeviz.journal.keys import digest_of
from modeviz.journal.opening import check_file, open_to_write
from modeviz.journal.ownership import Ownership
from modeviz.journal.pictures import PictureLine, write_picture
from modeviz.journal.places import own_folder
from modeviz.journal.records import Records
from modeviz.journal.runs import Run, write_run
from modeviz.journal.schema import create
from modeviz.journal.sessions import SessionId, StoredSession
from modeviz.journal.states import Stated, fewer, look_key
from modeviz.journal.upgrade import upgrade
from modeviz.journal.writer import Writer
from modeviz.report.notes import Note

PATIENCE = 5.0
"""s that reading waits for what was written before."""

IMPATIENCE = 0.2
"""s for the same while nothing can be written."""

EVERY = LONGEST
"""So many changes of a session that cannot be written are looked through at once."""

log = logging.getLogger(__name__)


class StudyFile(Records):
    """Writes what the sessions of a vehicle accept, in a thread of its own, and gives it back.

    What is asked to be written is in memory until it is on the disk: `trouble` says why that takes, and
    nothing is lost by it while the process lives. Every method may be called from any thread.
    """

    def __init__(
        self,
        path: Path,
        vehicle: Fingerprint,
        writer: Writer,
        ownership: Ownership,
        watchers: list[Callable[[str], None]],
        former: Path | None = None,
    ) -> None:
        """See `open`."""
        super().__init__(path, self._connect_after_writing)
        self.vehicle: Fingerprint = vehicle
        self.former: Path | None = former
        """The copy of a file that an earlier modeviz had written, and that was brought up to date."""
        self._writer, self._ownership, self._watchers = writer, ownership, watchers
        self._lock = threading.Lock()
        self._n_steps: dict[SessionId, int] = {}
        self._n_changes: dict[SessionId, int] = {}

    @classmethod
    def open(
        cls,
        path: Path | str,
        vehicle_name: str,
        vehicle: Fingerprint,
        tell: Callable[[str], None] = lambda trouble: None,
    ) -> "StudyFile":
        """Return the study in a file, which is made if there is none.

        Args:
            path: of the file; `<path>-wal`, `<path>-shm` and `<path>-lock` lie beside while it is open.
            vehicle_name: of the vehicle that is tuned.
            vehicle: what that is made of.
            tell: told in the writer's thread why nothing can be saved, "" once it can again.

        Raises:
            ModevizError: another process has it, it is damaged or no study, was written by a later
                modeviz, or cannot be written.
        """
        path, former = Path(path).absolute(), None
        _check_folder(path)
        ownership = Ownership(path, time.time())
        try:
            if check_file(path):
                former = upgrade(path)
            else:
                _create(path, vehicle_name)
            watchers = [tell]
            writer = Writer(path, partial(_tell_all, watchers))
        except (sqlite3.Error, OSError) as error:
            ownership.release()
            raise ModevizError(f"{path}: cannot be written ({reason(error)})") from None
        except ModevizError:
            ownership.release()
            raise
        return cls(path, vehicle, writer, ownership, watchers, former)

    @staticmethod
    def session_id(key: str) -> SessionId:
        """Return by what the methods here know a session or a review with that key."""
        return digest_of(key)

    @property
    def trouble(self) -> str:
        """Why nothing can be saved: "not saved since 14:03: the disk is full"; "" while it can."""
        return self._writer.trouble

    @property
    def n_unsaved(self) -> int:
        """How many writes are in memory alone."""
        return self._writer.n_waiting

    def watch(self, tell: Callable[[str], None]) -> Callable[[], None]:
        """Has somebody else told of `trouble`, at once if there is some; returns what ends that."""
        self._watchers.append(tell)
        if self.trouble:
            tell(self.trouble)
        return lambda: self._watchers.remove(tell)

    def begin(self, session: SessionId, author: str = "", title: str = "") -> None:
        """Writes that a session is used from now on with this vehicle, a new one or an old one."""
        now, vehicle = time.time(), self.vehicle
        self._writer.put(lambda c: stored.begin(c, session, vehicle, author, title, now), session)

    def record(self, session: SessionId, change: Change) -> None:
        """Writes a change that a session accepted."""
        key = self._key(session, change)
        self._writer.put(Stated(session, time.time(), change), session, key)
        if self.trouble and self._is_time_to_compact(session):
            self._writer.rework(session, Stated, fewer)

    def look(self, session: SessionId, state: str) -> None:
        """Writes how a session is looked at now; of several the newest counts."""
        self._writer.put(Stated(session, time.time(), state), session, look_key(session))

    def see(self, session: SessionId, view: str) -> None:
        """Writes how the pages of a session show it, as text; of several the newest counts."""
        self._writer.put(lambda c: stored.see(c, session, view), session, ("see", session))

    def name(self, session: SessionId, title: str) -> None:
        """Writes what the owner of a session calls it."""
        self._writer.put(lambda c: stored.name(c, session, title), session, ("name", session))

    def share(self, session: SessionId, review: SessionId, author: str) -> None:
        """Writes that a review shows a session, and who shared it."""
        now = time.time()
        self._writer.put(lambda c: stored.share(c, session, review, author, now), session)

    def end_reviews(self, session: SessionId) -> None:
        """Writes that the reviews of a session show nothing any more."""
        now = time.time()
        self._writer.put(lambda c: stored.end_reviews(c, session, now), session)

    def put_note(self, session: SessionId | None, note: Note) -> str:
        """Writes a note of a session, or with None one for all; returns its token.

        A note whose token is there already takes its place.
        """
        written = replace(note, token=note.token or new_token(), time=time.time())
        self._writer.put(
            lambda c: remarks.write_note(c, _number(c, session), written),
            session or "",
        )
        return written.token

    def remove_note(self, session: SessionId | None, token: str) -> None:
        """Takes a note away."""
        now = time.time()
        self._writer.put(
            lambda c: remarks.remove_note(c, _number(c, session), token, now), session or ""
        )

    def put_run(self, session: SessionId, run: Run) -> str:
        """Writes a run of a session, in place of one of its token; returns that."""
        written = replace(run, token=run.token or new_token(), time=time.time())
        self._writer.put(
            lambda c: write_run(c, stored.number_of(c, session), written),
            session,
            ("run", written.token),
            "run",
            len(run.record),
        )
        return written.token

    def put_picture(self, session: SessionId, png: bytes, caption: str, author: str = "") -> str:
        """Writes a picture of a session; returns its token."""
        line = PictureLine(new_token(), caption, author, time.time())
        self._writer.put(
            lambda c: write_picture(c, stored.number_of(c, session), line, png),
            session,
            what="picture",
            n_bytes=len(png),
        )
        return line.token

    def is_saved(self, session: SessionId) -> bool:
        """Whether all of a session is on the disk."""
        return not self._writer.holds(session)

    def restore(self, session: SessionId) -> StoredSession | None:
        """Return a session as it was left; None where there is none.

        Raises:
            ModevizError: it cannot be read, or is not saved yet, so that what there is of it is old.
        """
        self._wait()
        if not self.is_saved(session):  # asked first: it may be saved once it was read
            trouble = self.trouble or "not saved yet"
            raise ModevizError(f"{self.path}: the session cannot be opened now ({trouble}); try again")
        return super().restore(session)

    def flush(self, timeout: float) -> bool:
        """Waits until all is on the disk; whether that came within `timeout` s."""
        return self._writer.flush(timeout)

    def close(self, timeout: float = PATIENCE) -> bool:
        """Saves what is left and lets others have the file; whether all was saved in `timeout` s."""
        is_saved = self._writer.close(timeout)
        self._ownership.release()
        return is_saved

    def _key(self, session: SessionId, change: Change) -> Hashable:
        """By which a change is overtaken: a step that goes on by how it goes on then."""
        with self._lock:
            n_steps = self._n_steps.get(session, 0)
            if change.kind == "longer":
                return "longer", session, n_steps
            self._n_steps[session] = n_steps + 1
        return None

    def _is_time_to_compact(self, session: SessionId) -> bool:
        """Whether so many changes came since they were looked through that fewer may do."""
        with self._lock:
            n_changes = self._n_changes.get(session, 0) + 1
            self._n_changes[session] = n_changes % EVERY
        return n_changes == EVERY

    def _connect_after_writing(self) -> Connection:
        """A connection that sees what was asked to be written before, if it could be."""
        self._wait()
        return sqlite3.connect(f"{self.path.as_uri()}?mode=ro", uri=True, isolation_level=None)

    def _wait(self) -> None:
        """Waits for what was asked to be written before, for as long as one who reads may wait."""
        self.flush(IMPATIENCE if self.trouble else PATIENCE)


def _tell_all(watchers: Sequence[Callable[[str], None]], trouble: str) -> None:
    for tell in tuple(watchers):
        try:
            tell(trouble)
        except Exception:
            log.exception("somebody was not told: %s", trouble or "saved again")


def new_token() -> str:
    """Return a name that nothing else in any study has."""
    return secrets.token_hex(8)


def _number(connection: Connection, session: SessionId | None) -> int | None:
    return None if session is None else stored.number_of(connection, session)


def _check_folder(path: Path) -> None:
    if path.parent == own_folder():
        with suppress(OSError):  # said when the file is locked
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    if not path.parent.is_dir():
        raise ModevizError(f"{path}: cannot be written (there is no folder {path.parent})")
    if path.is_file() and not os.access(path, os.W_OK):
        raise ModevizError(f"{path}: is read-only: give another file with --study")


def _create(path: Path, vehicle_name: str) -> None:
    connection = open_to_write(path)
    try:
        create(connection, vehicle_name, time.time())
    finally:
        connection.close()
