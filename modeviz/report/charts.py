"""Line charts as SVG text: for paper, for files without a program behind them, in light and dark.

Colours are CSS variables; where a page does not define them, those of a light page are drawn.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from modeviz.text.axes import Axis
from modeviz.vehicle.arrays import Floats

BASE, NOW = "var(--mv-base, #98a2ad)", "var(--mv-now, #2b7cc4)"
PAPER = "var(--mv-paper, #fff)"
TEXT, GRID = "var(--mv-dim, #5b6670)", "var(--mv-line, #e2e6ea)"

LEFT, RIGHT, TOP, BOTTOM = 62, 14, 30, 44
"""Around the curves."""

LETTER = 6.0
"""Width of a letter, about."""

HALO = (
    ' font-weight="600" stroke="var(--mv-paper, #fff)" stroke-width="3" paint-order="stroke" '
    'stroke-linejoin="round"'
)
"""How a text that stands on lines is kept readable."""


@dataclass(frozen=True, eq=False)
class Curve:
    """A line of a chart."""

    label: str
    """What the legend calls it; "" if it is explained elsewhere."""
    x: Floats
    """(n,), rising."""
    y: Floats
    """(n,)."""
    color: str = NOW
    """CSS."""
    thickness: float = 2.0
    peaks: Sequence[int] = ()
    """Which points are marked; the marks say x."""
    dash: Sequence[float] = ()
    """Lengths of dashes and gaps; none is a full line."""
    points: Sequence[int] = ()
    """Which points have a ring, with nothing beside it."""


@dataclass(frozen=True)
class _Frame:
    """The place of a chart's values on the drawing."""

    x: Axis
    y: Axis
    width: float
    height: float

    def points(self, x, y) -> Floats:
        """(n, 2), from the upper left corner of the frame."""
        right, up = self.x.place(x), self.y.place(y)
        return np.stack([right * self.width, (1 - up) * self.height], axis=-1)


def line_chart(
    curves: Sequence[Curve], x: Axis, y: Axis, title: str, width: int = 640, height: int = 270
) -> str:
    """An SVG element that is as wide as there is room.

    Args:
        curves: the last is drawn on top.
        x: what is outside of it is not drawn.
        y: likewise.
        title: what is shown, for whoever cannot see it.
        width: together with `height` its proportions; letters are 11 of its units high.
        height: see `width`.
    """
    frame = _Frame(x, y, width - LEFT - RIGHT, height - TOP - BOTTOM)
    lines = "".join(_line(frame, curve) for curve in curves)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img" '
        f'aria-label="{escape(title)}" font-family="system-ui, sans-serif" font-size="11" '
        'style="display:block;width:100%;height:auto;font-variant-numeric:tabular-nums">'
        f"{_legend(curves)}"
        f'<g transform="translate({LEFT} {TOP})">{_grid(frame)}'
        # An inner svg cuts off what is outside and, unlike a clipPath, needs no id in the page.
        f'<svg width="{frame.width:g}" height="{frame.height:g}" overflow="hidden">{lines}</svg>'
        f"{_marks(frame, curves)}</g></svg>"
    )


def _line(frame: _Frame, curve: Curve) -> str:
    points = frame.points(curve.x, curve.y)
    # Far outside, coordinates are as good as any and may be too large for a browser.
    points = np.clip(points, -frame.width, 2 * frame.width)
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    dashes = f' stroke-dasharray="{" ".join(f"{d:g}" for d in curve.dash)}"' if curve.dash else ""
    return (
        f'<polyline points="{path}" fill="none" stroke="{curve.color}" '
        f'stroke-width="{curve.thickness:g}" stroke-linejoin="round"{dashes}/>'
    )


def _grid(frame: _Frame) -> str:
    """Grid lines with what they stand for, and the titles of the axes."""
    width, height = frame.width, frame.height
    parts = [f'<rect width="{width:g}" height="{height:g}" fill="none" stroke="{GRID}"/>']
    for value, label in frame.x.ticks():
        at = float(frame.x.place(value)) * width
        parts.append(f'<path d="M{at:.1f} 0V{height:g}" stroke="{GRID}"/>')
        parts.append(_text(at, height + 15, label))
    for value, label in frame.y.ticks():
        at = (1 - float(frame.y.place(value))) * height
        parts.append(f'<path d="M0 {at:.1f}H{width:g}" stroke="{GRID}"/>')
        parts.append(_text(-6, at + 4, label, anchor="end"))
    parts.append(_text(width / 2, height + 34, frame.x.title))
    turned = f' transform="rotate(-90) translate({-height / 2:g} {12 - LEFT})"'
    parts.append(_text(0, 0, frame.y.title, more=turned))
    return "".join(parts)


def _legend(curves: Sequence[Curve]) -> str:
    parts, at = [], float(LEFT)
    for curve in filter(lambda curve: curve.label, curves):
        sample = f'stroke="{curve.color}" stroke-width="{curve.thickness:g}"'
        parts.append(f'<path d="M{at:.1f} {TOP - 14}h18" {sample}/>')
        parts.append(_text(at + 24, TOP - 10, curve.label, anchor="start"))
        at += 24 + LETTER * len(curve.label) + 20
    return "".join(parts)


def _marks(frame: _Frame, curves: Sequence[Curve]) -> str:
    """A dot on every peak, and its x beside it where no other is written: the last curve's first."""
    parts, taken = [_rings(frame, curve) for curve in curves], []
    for curve in reversed(curves):
        peaks = sorted(curve.peaks, key=lambda i: -curve.y[i])
        for value, (x, y) in zip(
            curve.x[peaks], frame.points(curve.x[peaks], curve.y[peaks]), strict=True
        ):
            if not (0 <= x <= frame.width and 0 <= y <= frame.height):
                continue
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.6" fill="{curve.color}"/>')
            if all(abs(x - other_x) > 26 or abs(y - other_y) > 13 for other_x, other_y in taken):
                taken.append((x, y))
                parts.append(_text(x, y - 6, f"{value:.1f}", curve.color, more=HALO))
    return "".join(parts)


def _rings(frame: _Frame, curve: Curve) -> str:
    at = [*curve.points]
    places = frame.points(curve.x[at], curve.y[at]) if at else ()
    return "".join(
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.6" fill="{PAPER}" stroke="{curve.color}"/>'
        for x, y in places
        if 0 <= x <= frame.width and 0 <= y <= frame.height
    )


def _text(
    x: float, y: float, label: str, color: str = TEXT, anchor: str = "middle", more: str = ""
) -> str:
    place = f'x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{color}"'
    return f"<text {place}{more}>{escape(label)}</text>"
