"""The frequency ladder: natural frequencies before and now, joined where a shape went.

Places across are in percent, so that it is as wide as its panel and its text keeps its size.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

TOP, BOTTOM, HEIGHT = 8, 44, 70
MARGIN = 4.0
"""Percent, left and right of the scale."""

LABELS = 12
"""About how many numbers fit along the scale of a narrow panel."""

DIM, BASE, NOW = "var(--mantine-color-dimmed)", "var(--mv-base)", "var(--mv-now)"

Scale = tuple[int, int]
"""Hz: the part of the band that is drawn."""


@dataclass(frozen=True)
class Rail:
    """A line from a mode to where its shape went."""

    before: float
    """Its frequency with the rates compared with, Hz."""
    after: float
    """Now."""
    weak: bool
    """Whether it is the same shape only in part: drawn dashed."""
    strong: bool
    """Whether it belongs to the shown mode."""


def around(frequency_hz: Sequence[float]) -> Scale:
    """The scale of whole hertz that holds some frequencies, with room at both ends."""
    return max(math.floor(min(frequency_hz) - 0.5), 0), math.ceil(max(frequency_hz) + 0.5)


def ladder(
    before: Mapping[str, float],
    after: Mapping[str, float],
    rails: Sequence[Rail],
    shown: str,
    scale: Scale,
) -> str:
    """An SVG drawing: frequencies with the rates compared with above, those of now below.

    Args:
        before: Hz, by the modes' names.
        after: Hz, by the modes' names.
        rails: what to join; an end that is off the scale is drawn at its edge.
        shown: the name of the shown mode.
        scale: what part of the band to draw.
    """
    low, high = scale

    def x(f: float) -> float:
        return MARGIN + (100 - 2 * MARGIN) * (min(max(f, low), high) - low) / (high - low)

    def drawn(f: float) -> bool:
        return low <= f <= high

    parts = _grid(scale, x)
    for rail in sorted(rails, key=lambda r: r.strong):
        if drawn(rail.before) or drawn(rail.after):
            parts.append(_rail(rail, x))
    for name, f in before.items():
        if drawn(f):
            parts.append(_line(x(f), TOP - 6, x(f), TOP, BASE, 2, _tip(name, f)))
    for name, f in after.items():
        if drawn(f):
            thickness = 4 if name == shown else 2
            parts.append(_line(x(f), BOTTOM, x(f), BOTTOM + 7, NOW, thickness, _tip(name, f)))
    size = f'width="100%" height="{HEIGHT}" style="display:block;margin-bottom:4px"'
    return f"<svg {size}>{''.join(parts)}</svg>"


def _grid(scale: Scale, x) -> list[str]:
    """A line and a number at whole hertz, the last with the unit."""
    low, high = scale
    step = next(s for s in (1, 2, 5, 10) if (high - low) / s <= LABELS or s == 10)
    at = range(-(-low // step) * step, high + 1, step)
    lines = [_line(x(f), TOP, x(f), BOTTOM, "var(--mv-soft)", 1) for f in at]
    texts = [
        f'<text x="{x(f):.2f}%" y="{BOTTOM + 22}" text-anchor="middle" '
        f'fill="{DIM}" font-size="11">{f}{" Hz" if f == at[-1] else ""}</text>'
        for f in at
    ]
    return lines + texts


def _rail(rail: Rail, x) -> str:
    color, thickness = (NOW, 2) if rail.strong else (BASE, 1)
    dashes = ' stroke-dasharray="4 3"' if rail.weak else ""
    return _line(x(rail.before), TOP, x(rail.after), BOTTOM, color, thickness, more=dashes)


def _tip(name: str, frequency_hz: float) -> str:
    """Return the text that is shown where the pointer rests."""
    return f"<title>{escape(name)} {frequency_hz:.2f} Hz</title>"


def _line(
    x1: float,
    y1: float,
    x2: float,
    y2: float,
    color: str,
    thickness: float,
    inside: str = "",
    more: str = "",
) -> str:
    return (
        f'<line x1="{x1:.2f}%" y1="{y1}" x2="{x2:.2f}%" y2="{y2}" stroke="{color}" '
        f'stroke-width="{thickness}"{more}>{inside}</line>'
    )
