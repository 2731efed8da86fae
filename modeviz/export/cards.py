"""Cards of a Nastran input file as text.

After MSC Nastran's Quick Reference Guide, "The Bulk Data Section": small fields where these hold all
digits of a card's numbers, else large ones.
"""

import re
from collections.abc import Iterator, Sequence

Field = int | float | str | None
"""None is left empty."""

SMALL, LARGE = 8, 16
"""Columns of a field; the first one of a line has always eight."""

SAME = 1e-12
"""Relative: numbers this close are the same."""

LONGEST_LINE = 72
"""Columns of a comment."""


def card(name: str, fields: Sequence[Field]) -> str:
    """Return the lines of a card.

    Args:
        name: such as "PBUSH".
        fields: those after the name, eight for each line of small fields.
    """
    width = SMALL if all(_holds(field, SMALL) for field in fields) else LARGE
    per_line, mark = (8, "") if width == SMALL else (4, "*")
    texts = [_text(field, width).rjust(width) for field in fields]
    lines = [texts[i : i + per_line] for i in range(0, len(texts), per_line)]
    names = [name + mark, *[mark or "+"] * (len(lines) - 1)]
    return "".join(
        f"{first:<8}{''.join(line)}".rstrip() + "\n" for first, line in zip(names, lines, strict=True)
    )


def comment(text: str) -> str:
    """Return a text as comment lines in ASCII, one line or several."""
    words = text.encode("ascii", "replace").decode().split()
    return "".join(f"$ {line}\n" for line in _wrapped(words))


def _wrapped(words: Sequence[str]) -> Iterator[str]:
    line = ""
    for word in words:
        if line and len(line) + 1 + len(word) > LONGEST_LINE - 2:
            yield line
            line = ""
        line = f"{line} {word}".strip()
    yield line


def _holds(field: Field, width: int) -> bool:
    """Whether a field of so many columns has all digits of a number."""
    if not isinstance(field, float):
        return True
    return abs(_value(_real(field, width)) - field) <= SAME * abs(field)


def _text(field: Field, width: int) -> str:
    return _real(field, width) if isinstance(field, float) else "" if field is None else str(field)


def _real(value: float, width: int) -> str:
    """A number with as many digits as a field holds, as Nastran has it: 724., 1.23457+7."""
    for digits in range(17, 0, -1):
        text = _short(f"{value:.{digits}G}")
        if len(text) <= width:
            return text
    raise ValueError(value)  # no number of double precision is longer


def _short(text: str) -> str:
    """A number with a point, and without the E and the zeros of its exponent."""
    mantissa, _, exponent = text.partition("E")
    mantissa = mantissa if "." in mantissa else f"{mantissa}."
    return mantissa + (f"{int(exponent):+d}" if exponent else "")


def _value(text: str) -> float:
    return float(re.sub(r"(?<=[\d.])(?=[-+])", "E", text))
