"""Numbers and names as people write them."""

import math
import re
from collections import Counter
from collections.abc import Container, Sequence
from itertools import chain, count
from typing import Protocol

MINUS = "\N{MINUS SIGN}"
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value: float, decimals: int) -> str:
    """A number with a true minus."""
    text = f"{abs(value):.{decimals}f}"
    return MINUS + text if value < 0 and float(text) else text


def signed(value: float, decimals: int, unit: str = "") -> str:
    """A change with its sign and a true minus; nothing but the number where it rounds to zero."""
    text = f"{abs(value):.{decimals}f}"
    sign = "" if float(text) == 0 else "+" if value > 0 else MINUS
    return f"{sign}{text}{unit}"


def within_sentence(title: str) -> str:
    """A title in the middle of a sentence: its first letter small, also after a "~"."""
    at = title.startswith("~")
    return title[:at] + title[at : at + 1].lower() + title[at + 1 :]


def sentence_case(name: str) -> str:
    """A name with a capital, for a widget, which shows it as it is; "~cab yaw" is "~Cab yaw"."""
    mark, rest = ("~", name[1:]) if name.startswith("~") else ("", name)
    return mark + rest[:1].upper() + rest[1:]


class Labelled(Protocol):
    """Something that people call otherwise than files do."""

    @property
    def name(self) -> str: ...

    @property
    def label(self) -> str: ...


def told_apart(things: Sequence[Labelled]) -> dict[str, str]:
    """The names of things by what a widget calls them, with the name too where labels are alike."""
    labels = [sentence_case(thing.label) for thing in things]
    count = Counter(labels)
    return {
        label if count[label] == 1 else f"{label} ({thing.name})": thing.name
        for label, thing in zip(labels, things, strict=True)
    }


def ago(seconds: float) -> str:
    """Return how long ago something was, in words: "12 min ago"."""
    for unit, length in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= length:
            n = int(seconds / length)
            return f"{n} {'day' if unit == 'days' and n == 1 else unit} ago"
    return "just now"


def file_name(name: str, ending: str) -> str:
    """A name that every file system takes."""
    stem = re.sub(r"[^\w.-]+", "-", name.lower()).strip("-.")
    return f"{stem or 'modeviz'}.{ending}"


def power_of_ten(exponent: int) -> str:
    """10⁻³; the powers that are read at a glance are written out: 0.01 to 1000."""
    if -2 <= exponent <= 3:
        return f"{10.0**exponent:g}"
    return "10" + str(exponent).translate(SUPERSCRIPTS)


def scientific(value: float) -> str:
    """A positive number by its first digit, 7 × 10⁻⁸."""
    if value == 0 or not math.isfinite(value):
        return "0" if value == 0 else "∞"
    digit, exponent = f"{value:.0e}".split("e")
    return f"{digit} × 10{str(int(exponent)).translate(SUPERSCRIPTS)}"


def significant(value: float) -> str:
    """A positive number to four digits, those before the point in full: 1094, 137.8, 0.25."""
    if value == 0:
        return "0"
    decimals = max(0, 3 - math.floor(math.log10(value)))
    text = f"{value:.{decimals}f}"
    return text.rstrip("0").rstrip(".") if decimals else text


def in_a_box(value: float) -> float:
    """A number, zero or more, as a box has room for it: to four digits if it has more than five."""
    return value if float(f"{value:.5g}") == value else float(significant(value))


def percent_change(now: float, base: float) -> str:
    """The change of a value in percent; of nothing there is no percentage."""
    if base == 0:
        return "0.0 %" if now == 0 else "–"
    return signed(100 * (now / base - 1), 1, " %")


def free_name(name: str, taken: Container[str]) -> str:
    """Return a name, or the first of "name 2", "name 3" ... that is free."""
    numbered = (f"{name} {i}" for i in count(2))
    return next(free for free in chain((name,), numbered) if free not in taken)
