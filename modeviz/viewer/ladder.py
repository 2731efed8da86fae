"""The frequency ladder: natural frequencies before and now, joined where a shape went."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from html import escape

WIDTH, TOP, BOTTOM, HEIGHT = 440, 34, 70, 100
LOW, HIGH = 7.0, 16.0
"""Hz: the part of the band that is drawn."""

DIM, TEXT, BASE, NOW = (
    "var(--mantine-color-dimmed)",
    "var(--mantine-color-text)",
    "var(--mv-base)",
    "var(--mv-now)",
)


@dataclass(frozen=True)
class Rail:
    """Where the shape of a mode went."""

    before: float
    """Its frequency with the original rates, Hz."""
    after: float
    """Now."""
    weak: bool
    """Whether it is the same shape only in part: drawn dashed."""
    strong: bool
    """Whether it belongs to the shown mode."""


def ladder(
    before: Sequence[float], after: Sequence[float], rails: Sequence[Rail], shown: int, label: str
) -> str:
    """An SVG drawing: frequencies with the original rates above, those of now below.

    Args:
        before: Hz.
        after: Hz.
        rails: what to join, such as are drawn at one end at least; the other is then at the edge.
        shown: which of `after` is the shown mode.
        label: what is written above it.
    """
    parts = [_grid()]
    parts += [_rail(r) for r in sorted(rails, key=lambda r: r.strong)]
    parts += [_line(_x(f), TOP - 6, _x(f), TOP, BASE, 2) for f in before if drawn(f)]
    parts += [
        _line(_x(f), BOTTOM, _x(f), BOTTOM + 7, NOW, 3 if i == shown else 2)
        for i, f in enumerate(after)
        if drawn(f)
    ]
    parts += [
        f'<text x="0" y="14" font-size="11" fill="{DIM}">original</text>',
        f'<text x="0" y="{BOTTOM + 25}" font-size="11" fill="{NOW}">now</text>',
    ]
    if shown < len(after):
        middle = min(max(_x(after[shown]), 110), WIDTH - 90)
        parts.append(_text(middle, 22, label, TEXT, 'font-weight="600"'))
    view = f'viewBox="0 0 {WIDTH} {HEIGHT}" width="100%" style="display:block"'
    return f"<svg {view}>{''.join(parts)}</svg>"


def drawn(frequency_hz: float) -> bool:
    """Whether a frequency is on the scale."""
    return LOW < frequency_hz < HIGH


def _x(f: float) -> float:
    """Where a frequency is drawn, one off the scale at its edge."""
    return 30 + (min(max(f, LOW), HIGH) - LOW) / (HIGH - LOW) * (WIDTH - 50)


@cache
def _grid() -> str:
    whole = range(int(LOW) + 1, int(HIGH))
    lines = "".join(_line(_x(f), TOP, _x(f), BOTTOM, "var(--mv-soft)", 1) for f in whole)
    labels = [f"{f} Hz" if f == whole[-1] else str(f) for f in whole]
    texts = (_text(_x(f), BOTTOM + 25, t, DIM) for f, t in zip(whole, labels, strict=True))
    return lines + "".join(texts)


def _rail(rail: Rail) -> str:
    color, thickness = (NOW, 2) if rail.strong else (BASE, 1)
    dashes = ' stroke-dasharray="4 3"' if rail.weak else ""
    return _line(_x(rail.before), TOP, _x(rail.after), BOTTOM, color, thickness, dashes)


def _line(
    x1: float, y1: float, x2: float, y2: float, color: str, thickness: float, more: str = ""
) -> str:
    return (
        f'<line x1="{x1:.1f}" y1="{y1}" x2="{x2:.1f}" y2="{y2}" stroke="{color}" '
        f'stroke-width="{thickness}"{more}/>'
    )


def _text(at: float, y: float, label: str, color: str, style: str = "") -> str:
    return (
        f'<text x="{at:.1f}" y="{y}" text-anchor="middle" fill="{color}" font-size="11" {style}>'
        f"{escape(label)}</text>"
    )
