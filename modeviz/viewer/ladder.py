"""The frequency ladder: where the modes were and where they are, as a drawing."""

from modeviz.viewer.html import title

WIDTH, TOP, BOTTOM = 440, 34, 70
LADDER_HZ = (7.0, 16.0)
MIDDLE = 'text-anchor="middle"'
DIM, STRONG = "var(--mantine-color-dimmed)", "var(--mv-now)"


def ladder(base: dict[str, float], now: dict[str, float], shown: str) -> str:
    """Natural frequencies above, before, joined to those below, now: an SVG drawing.

    Args:
        base: frequency of each named mode, Hz.
        now: the same with the present rates.
        shown: the name of the shown mode, drawn strong.
    """
    low, high = LADDER_HZ
    names = [n for n in now if n in base and low < base[n] < high and low < now[n] < high]
    rungs = [_rung(_x(base[name]), _x(now[name]), name == shown) for name in names]
    caption = _caption(shown, base[shown], now[shown]) if shown in names else ""
    return (
        f'<svg viewBox="0 0 {WIDTH} 100" width="100%" style="display:block">'
        f"{LADDER_SCALE}{''.join(rungs)}{caption}</svg>"
    )


def _rung(before: float, after: float, is_shown: bool) -> str:
    """A mark above, one below and the line that joins them."""
    joint = (STRONG, 2) if is_shown else ("var(--mv-base)", 1)
    return (
        _line(before, TOP - 6, before, TOP, "var(--mv-base)", 2)
        + _line(before, TOP, after, BOTTOM, *joint)
        + _line(after, BOTTOM, after, BOTTOM + 7, STRONG, 3 if is_shown else 2)
    )


def _caption(name: str, before: float, after: float) -> str:
    middle = min(max(_x(before), 110), WIDTH - 90)
    label = f"{title(name)} {before:.2f} → {after:.2f}"
    return _text(middle, 22, label, "var(--mantine-color-text)", f'{MIDDLE} font-weight="600"')


def _x(frequency_hz: float) -> float:
    low, high = LADDER_HZ
    return 30 + (frequency_hz - low) / (high - low) * (WIDTH - 50)


def _line(x1: float, y1: float, x2: float, y2: float, color: str, thickness: float) -> str:
    return (
        f'<line x1="{x1:.1f}" y1="{y1}" x2="{x2:.1f}" y2="{y2}" stroke="{color}" '
        f'stroke-width="{thickness}"/>'
    )


def _text(x: float, y: float, label: str, color: str, style: str = MIDDLE) -> str:
    return f'<text x="{x:.1f}" y="{y}" fill="{color}" font-size="11" {style}>{label}</text>'


def _ladder_scale() -> str:
    """A line and its number at every whole hertz, and what is above and below."""
    first, last = int(LADDER_HZ[0]) + 1, int(LADDER_HZ[1]) - 1
    lines = [_line(_x(f), TOP, _x(f), BOTTOM, "var(--mv-soft)", 1) for f in range(first, last + 1)]
    numbers = [_text(_x(f), BOTTOM + 25, str(f), DIM) for f in range(first, last)]
    unit = _text(_x(last), BOTTOM + 25, f"{last} Hz", DIM)
    sides = _text(0, 14, "original", DIM, "") + _text(0, BOTTOM + 25, "now", STRONG, "")
    return "".join(lines + numbers) + unit + sides


LADDER_SCALE = _ladder_scale()
