"""The secret in a link: where it comes from, and how often somebody may guess at it."""

import hmac
import os
import re
import secrets
import time
from collections import OrderedDict
from collections.abc import Callable
from pathlib import Path

from modeviz.errors import ModevizError

VARIABLE = "MODEVIZ_TOKEN"
"""Of the environment."""

SHORTEST = 12
"""Characters: at the rate at which guesses are answered, more than anybody can try."""

LONGEST = 256

FREE_GUESSES = 3
"""Answered at once: a link can be copied wrongly."""

DELAY = 1.0
"""s: how long each guess after these takes."""

MOST_GUESSES = 10
"""In a row, before whoever guesses is locked out."""

LOCKED_S = 300.0

MOST_CLIENTS = 1000
"""Whose guesses are remembered."""


def new_token() -> str:
    """A token that nobody guesses."""
    return secrets.token_urlsafe()


def chosen_token(token: str | None, file: Path | None, is_wanted: bool) -> str | None:
    """The token to ask for: that given, of a file, of the environment, or else a new one.

    Args:
        token: as given.
        file: that holds it.
        is_wanted: whether there is to be one.

    Raises:
        ModevizError: the file can't be read, or what is given is no good token.
    """
    if not is_wanted:
        return None
    if token is not None:
        return checked_token(token, "--token")
    if file is not None:
        return checked_token(_content(file), f"--token-file {file}")
    if found := os.environ.get(VARIABLE):
        return checked_token(found, VARIABLE)
    return new_token()


def checked_token(token: str, where: str) -> str:
    """A token that is long enough and goes into a link; raises ModevizError for another."""
    if not re.fullmatch(r"[\w.~-]+", token, re.ASCII):
        raise ModevizError(f"{where}: expected letters, digits, '-', '.', '_' and '~' only")
    if not SHORTEST <= len(token) <= LONGEST:
        raise ModevizError(
            f"{where}: found {len(token)} characters, expected {SHORTEST} to {LONGEST}, such as "
            f"{new_token()}"
        )
    return token


def is_equal(given: str, secret: str) -> bool:
    """Whether they are the same, in a time that tells nothing of where they differ."""
    return hmac.compare_digest(given.encode("utf-8", "surrogateescape"), secret.encode())


class Guesses:
    """Counts the wrong tokens of each client."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        """Starts with nobody having guessed; `clock` tells the time, s."""
        self._clock = clock
        self._wrong: OrderedDict[str, tuple[int, float]] = OrderedDict()
        """How many in a row, and until when that locks out."""

    def note(self, client: str) -> None:
        """Counts a wrong one, and locks out who brought too many."""
        n_wrong = self._wrong.pop(client, (0, 0.0))[0] + 1
        is_locked = n_wrong >= MOST_GUESSES
        self._wrong[client] = (0, self._clock() + LOCKED_S) if is_locked else (n_wrong, 0.0)
        if len(self._wrong) > MOST_CLIENTS:
            self._wrong.popitem(last=False)

    def forget(self, client: str) -> None:
        """Starts anew with who brought the right one."""
        self._wrong.pop(client, None)

    def delay(self, client: str) -> float:
        """Return the time that an answer to a client is to take, s."""
        return DELAY if self._wrong.get(client, (0, 0.0))[0] >= FREE_GUESSES else 0.0

    def locked(self, client: str) -> float:
        """Return the time for which a client is still locked out, s; 0 if it is not."""
        return max(self._wrong.get(client, (0, 0.0))[1] - self._clock(), 0.0)


def _content(file: Path) -> str:
    """The text in a small file, without what editors put at its end."""
    try:
        with file.open("rb") as opened:
            return opened.read(LONGEST + 3).decode("utf-8-sig").strip()
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not text"
        raise ModevizError(f"--token-file {file}: {reason}") from None
