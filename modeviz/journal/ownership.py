"""Whose a study file is: one process writes what its sessions do, and others are told which."""

import json
import os
import socket
import sys
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

from modeviz.errors import ModevizError, reason

BEYOND = 1 << 30
"""The byte that is locked on Windows, where what is locked cannot be read."""

if sys.platform == "win32":
    import msvcrt

    def _lock(file: int) -> None:
        os.lseek(file, BEYOND, os.SEEK_SET)
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
        os.lseek(file, 0, os.SEEK_SET)
else:
    import fcntl

    def _lock(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


class Ownership:
    """Holds a study file for this process, until it is released or the process ends, however it does.

    The lock is on a file beside it, which says who has it. What is left of that file by a process that
    was killed locks nothing.
    """

    def __init__(self, study: Path, now: float) -> None:
        """Takes the file.

        Raises:
            ModevizError: another process has it, or the lock cannot be written.
        """
        self._path = lock_path(study)
        self._file = self._locked(study)
        owner = {"pid": os.getpid(), "host": socket.gethostname(), "since": now}
        with suppress(OSError):  # on a full disk it holds, and says nothing
            os.ftruncate(self._file, 0)
            os.write(self._file, json.dumps(owner).encode())

    def release(self) -> None:
        """Lets others have the file."""
        with suppress(OSError):
            self._path.unlink()
        with suppress(OSError):
            os.close(self._file)

    def _locked(self, study: Path) -> int:
        while True:
            try:
                file = os.open(self._path, os.O_RDWR | os.O_CREAT | getattr(os, "O_CLOEXEC", 0), 0o600)
            except OSError as error:
                raise ModevizError(
                    f"{study}: cannot be locked ({reason(error)}): give another file with --study"
                ) from None
            try:
                _lock(file)
            except OSError:
                os.close(file)
                raise ModevizError(f"{study}: {_taken(self._path)}") from None
            if _is_at(file, self._path):
                return file
            os.close(file)  # the one who had it has just removed it


def lock_path(study: Path) -> Path:
    """Return the file beside a study file that is locked."""
    return study.with_name(f"{study.name}-lock")


def _is_at(file: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(file), path.stat())
    except FileNotFoundError:
        return False


def _taken(path: Path) -> str:
    owner = _owner(path)
    who = "another process"
    if owner:
        since = time.strftime("%d %b %H:%M", time.localtime(owner["since"]))
        who = f"process {owner['pid']} on {owner['host']} since {since}"
    return f"is open already, in {who}: close that one, or give another file with --study"


def _owner(path: Path) -> dict[str, Any] | None:
    """What the lock says of who has it; None where it says nothing yet."""
    with suppress(OSError, ValueError, OverflowError, TypeError, KeyError):
        owner = json.loads(path.read_text())
        said = {"pid": int(owner["pid"]), "host": str(owner["host"])[:80]}
        since = float(owner["since"])
        time.localtime(since)
        return {**said, "since": since}
    return None
