"""Tokens that are kept for a user, so that links and open pages outlive the server: a file for each."""

import errno
import hashlib
import os
import re
import stat
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from modeviz.files.state_folder import state_folder
from modeviz.viewer.page.doors.tokens import LONGEST, SHORTEST, new_token

LIFE_S = 30 * 86400.0
"""How long one is kept after a server has last asked for it."""

RENEWED_S = 86400.0
"""How often it is noted that a server asks for it."""

LARGEST = 100_000
"""Bytes of a file: a token, and the paths of what it opens."""

GOOD = re.compile(rf"[\w-]{{{SHORTEST},{LONGEST}}}", re.ASCII)


@dataclass(frozen=True)
class KeptToken:
    """A token in a file of the user's own: its first line; the next tell what it opens."""

    path: Path
    opens: tuple[str, ...]
    """Of what is shown: absolute paths."""
    clock: Callable[[], float] = time.time

    def token(self) -> str:
        """Return the token; a new one if there is none, its life is over, or others could read it.

        Raises:
            OSError: it cannot be kept.
        """
        held = self.held()
        if held is None:
            return self.replace()
        if abs(self.age()) > RENEWED_S:  # the clock may have been set back
            with suppress(OSError):
                self._note_use(self.path)
        return held

    def held(self) -> str | None:
        """Return the token that is kept, if it is still good.

        Raises:
            OSError: it cannot be read though it is there.
        """
        try:
            with open(self.path, "rb", opener=_not_elsewhere) as file:
                status = os.fstat(file.fileno())
                first = file.readline(LONGEST + 2).decode("ascii", "replace").rstrip("\n")
        except OSError as error:
            if error.errno in (errno.ENOENT, errno.ELOOP):  # not there, or a link to another file
                return None
            raise
        age = self.clock() - status.st_mtime
        is_good = age <= LIFE_S and _is_private(status) and GOOD.fullmatch(first)
        return first if is_good else None

    def replace(self) -> str:
        """Return a new token, in place of that which is kept.

        Raises:
            OSError: it cannot be kept.
        """
        token = new_token()
        self.path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        handle, written = tempfile.mkstemp(dir=self.path.parent, prefix=".")  # which only we may read
        try:
            with open(handle, "w", encoding="utf-8", errors="surrogateescape") as file:
                file.write("\n".join([token, *self.opens, ""]))
            self._note_use(written)
            os.replace(written, self.path)
        except OSError:
            os.unlink(written)
            raise
        return token

    def age(self) -> float:
        """Return the time since a server has last asked for it, s.

        Raises:
            OSError: there is none.
        """
        return self.clock() - self.path.stat().st_mtime

    def _note_use(self, path: str | Path) -> None:
        now = self.clock()
        os.utime(path, (now, now))


def kept_token(what: Sequence[Path]) -> KeptToken:
    """Return the token that opens these vehicles or files, and nothing else."""
    opens = tuple(str(path.resolve()) for path in what)
    digest = hashlib.sha256("\n".join(opens).encode("utf-8", "surrogateescape")).hexdigest()
    return KeptToken(_folder() / digest[:32], opens)


def kept_tokens() -> Iterator[KeptToken]:
    """Yields those that are still good, and deletes the others."""
    for path in sorted(_folder().glob("[0-9a-f]*")):
        try:
            with open(path, "rb", opener=_not_elsewhere) as file:
                lines = file.read(LARGEST).decode("utf-8", "surrogateescape").splitlines()
            kept = KeptToken(path, tuple(lines[1:]))
            if kept.held() is None:
                path.unlink()
            else:
                yield kept
        except OSError:  # deleted meanwhile
            continue


def _folder() -> Path:
    return state_folder() / "tokens"


def _is_private(status: os.stat_result) -> bool:
    """Whether a file is the user's own, and nobody else may read or change it."""
    if os.name != "posix":
        return True
    return status.st_uid == os.geteuid() and not stat.S_IMODE(status.st_mode) & 0o077


def _not_elsewhere(path: str, flags: int) -> int:
    """Opens a file that is no link to another, and does not wait for one that never ends."""
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))
