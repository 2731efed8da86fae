"""What is printed, whatever prints it: no control characters, and letters that are there."""

import io
import os
import re
import sys
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import TextIO

from modeviz.errors import ModevizError

CONTROL = re.compile(
    "[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]"
)
"""What a terminal obeys, or reads from right to left, or is no letter at all; not tab and line end."""

PLAIN = {
    "−": "-", "–": "-", "—": "-", "‐": "-", "·": "*", "×": "x", "÷": "/", "±": "+/-", "→": "->",
    "⇒": "=>", "↑": "^", "∞": "inf", "√": "sqrt", "°": " deg", "‖": "|", "≤": "<=", "≥": ">=",
    "“": '"', "”": '"', "„": '"', "‘": "'", "’": "'", "◀": "<", "▶": ">", "ß": "ss", "ø": "o",
    "Ø": "O", "æ": "ae", "Æ": "AE", "ł": "l", "Ł": "L", "φ": "phi", "ψ": "psi", "ω": "omega",
    "ζ": "zeta", "λ": "lambda", "θ": "theta", "δ": "delta", "Δ": "Delta", "σ": "sigma", "Σ": "sum",
    "π": "pi", "τ": "tau", "ε": "epsilon", "μ": "u", "µ": "u", "∂": "d",
}  # fmt: skip
"""What stands for letters that a terminal lacks, where taking off their accents doesn't do."""

POWER_OF_TEN = re.compile("(?<=10)[⁻⁰¹²³⁴-⁹]+")


def printable(text: str) -> str:
    """The text with control characters as their codes, which are those of JSON."""
    return CONTROL.sub(lambda found: f"\\u{ord(found[0]):04x}", text)


def one_line(text: str) -> str:
    """The text without line ends, such as a name may have."""
    return " ".join(text.splitlines())


def plain(text: str, encoding: str) -> str:
    """The text in letters that the encoding has."""
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        level = POWER_OF_TEN.sub(lambda power: "^" + unicodedata.normalize("NFKD", power[0]), text)
        return "".join(_plain_letter(letter, encoding) for letter in level)
    return text


def _plain_letter(letter: str, encoding: str) -> str:
    without_accents = unicodedata.normalize("NFKD", letter)
    for choice in (letter, PLAIN.get(letter, ""), without_accents, without_accents[0]):
        if choice and choice.encode(encoding, "replace").decode(encoding) == choice:
            return choice
    return "?"


class Printed(io.TextIOBase):
    """A stream of Python's own to which only `printable` and `plain` text goes."""

    def __init__(self, stream: TextIO | None, name: str = ""):
        """Wraps a stream.

        Args:
            stream: what is written to, None where it was closed before the program began.
            name: what the user is told who lacks what is written there; nobody, if empty.
        """
        self._stream, self._name = stream, name

    @property
    def encoding(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        return getattr(self._stream, "encoding", None) or "utf-8"

    def writable(self) -> bool:
        return True

    def isatty(self) -> bool:
        return self._stream is not None and self._stream.isatty()

    def fileno(self) -> int:
        if self._stream is None:
            raise io.UnsupportedOperation("closed before the program began")
        return self._stream.fileno()

    def check(self) -> None:
        """Checks that something can be written.

        Raises:
            ModevizError: the stream is closed, or what it leads to is full.
        """
        with self._told():
            if self._stream is None:
                raise OSError("it is closed")
            with suppress(io.UnsupportedOperation):  # a stream that is no file
                os.write(self._stream.fileno(), b"")

    def write(self, text: str, /) -> int:
        with self._told():
            if self._stream is None:
                raise OSError("it is closed")
            self._stream.write(plain(printable(text), self.encoding))
        return len(text)

    def flush(self) -> None:
        with self._told():
            if self._stream is not None:
                self._stream.flush()

    @contextmanager
    def _told(self) -> Iterator[None]:
        """Whoever reads, such as `head`, may have enough; that nobody can read is said.

        Raises:
            ModevizError: the stream cannot be written.
        """
        try:
            yield
        except BrokenPipeError:
            self._give_up()
        except OSError as error:
            self._give_up()
            if self._name:
                raise ModevizError(
                    f"{self._name} cannot be written ({error.strerror or error})"
                ) from None

    def _give_up(self) -> None:
        """Lets what is still to be written go nowhere, or Python would fail again at its end."""
        if self._stream is not None:
            os.dup2(os.open(os.devnull, os.O_WRONLY), self._stream.fileno())


@contextmanager
def printed_plainly() -> Iterator[None]:
    """Cleans all that is printed inside: by us, by libraries and by our own mistakes."""
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = Printed(before[0], "standard output"), Printed(before[1])
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before
