"""The lines of a file that make it no TOML, taken out so that the rest can be read."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

MOST_BROKEN = 20
"""Lines: a file with more is hardly meant to be TOML."""

_AT_LINE = re.compile(r" \(at line (\d+), column \d+\)$")


@dataclass(frozen=True)
class BrokenLine:
    """A line that was taken out."""

    number: int
    """From one; zero if the whole cannot be read for another reason."""
    words: str
    """What is wrong with it."""


def without_broken_lines(
    text: str, error_of: Callable[[str], str | None]
) -> tuple[str | None, tuple[BrokenLine, ...]]:
    """Return a text whose broken lines are empty, None if nothing can be read of it, and these lines.

    Where an error is told may be after where it is, as with a list that is not closed: of what could be
    taken out, that is, which lets the reader get furthest.

    Args:
        text: of the file.
        error_of: what keeps a text from being read, with the line as `tomllib` tells it; None: nothing.
    """
    lines, broken = text.split("\n"), list[BrokenLine]()
    while (error := error_of("\n".join(lines))) is not None:
        number = _line(error, len(lines))
        if number is None or len(broken) == MOST_BROKEN:
            return None, (broken[0] if broken else BrokenLine(number or 0, _AT_LINE.sub("", error)),)
        choices = list(_choices(lines, number))
        furthest = [_furthest(error_of, lines, choice) for choice in choices]
        chosen = choices[furthest.index(max(furthest))]
        broken.append(BrokenLine(chosen.start + 1, _AT_LINE.sub("", error)))
        lines[chosen] = [""] * (chosen.stop - chosen.start)
    return "\n".join(lines), tuple(broken)


def _line(error: str, n_lines: int) -> int | None:
    """The line that an error tells, from one."""
    if found := _AT_LINE.search(error):
        return int(found[1])
    return n_lines if error.endswith("(at end of document)") else None


def _choices(lines: list[str], number: int) -> Iterator[slice]:
    """What could be taken out for an error at a line: that one, the one before it, or its table."""
    here = number - 1
    yield slice(here, number)
    before = next((i for i in range(here - 1, -1, -1) if lines[i].strip()), None)
    if before is not None:
        yield slice(before, before + 1)
    if lines[here].lstrip().startswith("["):
        after = (i for i in range(number, len(lines)) if lines[i].lstrip().startswith("["))
        yield slice(here, next(after, len(lines)))


def _furthest(error_of: Callable[[str], str | None], lines: list[str], without: slice) -> float:
    """The line that is reached without some, endless if that is all."""
    rest = [*lines[: without.start], *[""] * (without.stop - without.start), *lines[without.stop :]]
    error = error_of("\n".join(rest))
    return float("inf") if error is None else _line(error, len(lines)) or 0
