"""What opens the page: a token, which may change, and the cookies of those who have brought it."""

import hashlib
import hmac
import os
import re
import threading
import time
import weakref
from base64 import urlsafe_b64encode
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from modeviz.errors import ModevizError
from modeviz.viewer.page.doors.kept_tokens import LIFE_S, kept_token
from modeviz.viewer.page.doors.tokens import checked_token, is_equal, new_token, token_of

VARIABLE = "MODEVIZ_TOKEN"
"""Of the environment."""

LOOK_S = 1.0
"""s between two looks whether a file holds another token."""

ROUNDS = 100_000
"""Of hashing a token: who has a cookie cannot try many words in its place."""

COOKIE = re.compile(r"(\d{1,12})\.([\w-]{43})", re.ASCII)
"""When it was given out, s since 1970, and what only who knows the token can make of that."""


class Secret:
    """A token and its cookies. Whoever changes the token ends them all."""

    def __init__(self, source: str | Callable[[], str], clock: Callable[[], float] = time.time) -> None:
        """Looks for the token.

        Args:
            source: the token, or what reads it from where it may change.
            clock: tells the time, s since 1970.

        Raises:
            ModevizError, OSError: as the source does.
        """
        self._source, self._clock = source, clock
        self._lock = threading.Lock()
        self._token: str | None = source if isinstance(source, str) else source()
        self._key = b""
        self._listeners: list[Callable[[], None]] = []

    @property
    def token(self) -> str | None:
        """That which is asked for now; None while it cannot be read, and nobody gets in."""
        self.look()
        return self._token

    def is_token(self, given: str) -> bool:
        """Whether this is the token."""
        token = self.token
        return token is not None and is_equal(given, token)

    def cookie(self) -> str:
        """Return what the cookie of who has brought the token holds.

        It tells nothing of the token, and of how near a guess was.
        """
        issued = f"{self._clock():.0f}"
        return f"{issued}.{self._signature(issued)}"

    def age(self, cookie: str) -> float | None:
        """Return the time since a cookie was given out, s; None if it was not, or its life is over."""
        self.look()
        match = COOKIE.fullmatch(cookie)
        if match is None or not is_equal(match[2], self._signature(match[1])):
            return None
        age = self._clock() - int(match[1])
        return age if age <= LIFE_S else None

    def look(self) -> None:
        """Sees whether the token has changed, and tells who listens."""
        if isinstance(self._source, str):
            return
        with self._lock:
            found = self._found(self._source)
            if found == self._token:
                return
            self._token, self._key = found, b""
            listeners = tuple(self._listeners)
        for listener in listeners:
            listener()

    def listen(self, listener: Callable[[], None]) -> None:
        """Has it called, in any thread, within a second after the token has changed."""
        with self._lock:
            is_first, self._listeners = not self._listeners, [*self._listeners, listener]
        if is_first and not isinstance(self._source, str):
            looking = partial(_keep_looking, weakref.ref(self))
            threading.Thread(target=looking, name="token", daemon=True).start()

    def _signature(self, issued: str) -> str:
        """What only who knows the token makes of a time; of no token, what is never the same again."""
        with self._lock:
            if self._token and not self._key:
                self._key = _key(self._token)
            digest = hmac.digest(self._key or os.urandom(32), issued.encode(), "sha256")
        return urlsafe_b64encode(digest).decode().rstrip("=")

    def _found(self, source: Callable[[], str]) -> str | None:
        """The token as it is now: that before where it cannot be kept, none where it is not good."""
        try:
            return source()
        except OSError:
            return self._token
        except ModevizError:
            return None


def chosen_secret(
    token: str | None,
    file: Path | None,
    is_wanted: bool,
    what: Sequence[Path],
    tell: Callable[[str], None],
) -> Secret | None:
    """Return what to ask for: a token given, of a file, of the environment, or else one that is kept.

    Args:
        token: as given.
        file: that holds it.
        is_wanted: whether there is to be one.
        what: is shown, vehicles or files: the token that is kept for these opens nothing else.
        tell: told that no token can be kept.

    Raises:
        ModevizError: the file can't be read, or what is given is no good token.
    """
    if not is_wanted:
        return None
    if token is not None:
        return Secret(checked_token(token, "--token"))
    if file is not None:
        return Secret(partial(token_of, file))
    if found := os.environ.get(VARIABLE):
        return Secret(checked_token(found, VARIABLE))
    try:
        return Secret(kept_token(what).token)
    except OSError as error:
        tell(f"the token ends with this server, it cannot be kept: {error.filename}: {error.strerror}")
        return Secret(new_token())


def _key(token: str) -> bytes:
    return hashlib.pbkdf2_hmac("sha256", token.encode(), b"cookies of modeviz", ROUNDS)


def _keep_looking(secret: weakref.ref[Secret]) -> None:
    while (found := secret()) is not None:
        found.look()
        del found
        time.sleep(LOOK_S)
