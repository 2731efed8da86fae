"""The token in a link: what is a good one, and the files that hold it."""

import hmac
import re
import secrets
from pathlib import Path

from modeviz.errors import ModevizError

SHORTEST = 12
"""Characters: at the rate at which guesses are answered, more than anybody can try."""

LONGEST = 256


def new_token() -> str:
    """A token that nobody guesses."""
    return secrets.token_urlsafe()


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


def token_of(file: Path) -> str:
    """The token in a file that the user has written, without what editors put at its end.

    Raises:
        ModevizError: the file can't be read, or what it holds is no good token.
    """
    try:
        with file.open("rb") as opened:
            content = opened.read(LONGEST + 3).decode("utf-8-sig").strip()
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not text"
        raise ModevizError(f"--token-file {file}: {reason}") from None
    return checked_token(content, f"--token-file {file}")


def is_equal(given: str, secret: str) -> bool:
    """Whether they are the same, in a time that tells nothing of where they differ."""
    return hmac.compare_digest(given.encode("utf-8", "surrogateescape"), secret.encode())
