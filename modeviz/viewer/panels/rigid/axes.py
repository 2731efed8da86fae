"""Axes and centres of a body as a table, beside each other as it is held and as it is mounted."""

from html import escape

from modeviz.analysis.rigid import BodyAxes
from modeviz.report.rigid import axis_rows, torque_word, vector
from modeviz.shapes.colors import Color
from modeviz.text.wording import sentence_case
from modeviz.viewer.page.widgets.html import heading, hinted, row, span, table
from modeviz.viewer.scene.rigid_axes import CENTER, FOCUS, ROLL, TORQUE
from modeviz.viewer.session.answers import Solved

COLORS = {"elastic torque axis": TORQUE, "elastic centre, m": CENTER}
"""Of what is drawn, by the names of its rows."""

DECIMALS = 3

HEADER = (
    "",
    hinted("Other ends still", "The other ends of what holds the body do not move"),
    hinted("As mounted", "On all that is elastic, down to the ground"),
)


def axes_content(solved: Solved) -> str:
    """Return axes and centres of the body that is looked at, with the colours of what is drawn."""
    axes = solved.rigid_axes
    roll = axes.torque_roll_axis
    free = [
        row([sentence_case(torque_word(axes)), vector(axes.crank, DECIMALS)]),
        row([_swatch(ROLL) + "Torque roll axis, free", vector(roll and roll.direction, DECIMALS)]),
        *_focus(axes),
    ]
    held, mounted = axis_rows(axes.held, DECIMALS), axis_rows(axes.mounted, DECIMALS)
    rows = [row([_label(name), _numbers(held[name]), _numbers(mounted[name])]) for name in held]
    return (
        heading("Axes and centres", "x, y, z") + table((), free, "axes") + table(HEADER, rows, "axes")
    )


def _focus(axes: BodyAxes) -> list[str]:
    if axes.focus is None:
        return []
    names, miss = escape(", ".join(axes.focus.mounts)), 1e3 * axes.focus.miss
    label = hinted(_swatch(FOCUS) + "Focus of inclined mounts, m", names)
    missed = span(f"within {miss:.0f} mm", "dim")
    return [row([label, f"{vector(axes.focus.point, DECIMALS)} {missed}"])]


def _label(name: str) -> str:
    words = name.strip()
    text = escape(words[:1].upper() + words[1:])
    return (_swatch(COLORS[name]) if name in COLORS else "") + text


def _numbers(text: str) -> str:
    """Numbers of a row, a rate on a line below its direction."""
    return escape(text).replace(": ", "<br>")


def _swatch(color: Color) -> str:
    return f'<i class="swatch" style="background:rgb{color}"></i>'
