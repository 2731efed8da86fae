"""One file that still moves without a server: the scene, and beside it what there is to read of it."""

import json
from collections.abc import Sequence
from dataclasses import replace
from html import escape
from importlib.resources import files

import numpy as np
import viser

from modeviz.report.charts import BASE, Curve, line_chart
from modeviz.report.charts import NOW as NOW_COLOR
from modeviz.report.rate_fields import direction, fields_of_groups, quantity, sections
from modeviz.text.axes import Axis, shown_hz
from modeviz.text.wording import signed
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats
from modeviz.viewer.page.doors.page_file import named_page
from modeviz.viewer.page.recording import recorded_page
from modeviz.viewer.page.widgets.html import block, row, span, style_sheet, table, title
from modeviz.viewer.panels.charts import chart_lines, legend
from modeviz.viewer.panels.color_scale import color_scale_text
from modeviz.viewer.panels.modes import listed, moved_by
from modeviz.viewer.panels.peaks import strongest
from modeviz.viewer.panels.plots import Line, Scale, level_axis, level_range
from modeviz.viewer.scene.driver import DRIVER
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.coloring import color_scale
from modeviz.viewer.session.responses import Responses, curve_label
from modeviz.viewer.session.state import ChartCurve, ForceCurve
from modeviz.viewer.session.wheel_responses import NOW


def offline_page(
    server: viser.ViserServer,
    solved: Solved,
    name: str,
    dark: bool,
    position: Floats,
    look_at: Floats,
) -> bytes:
    """An HTML file, UTF-8, with the scene of a server and the plots and tables of an answer beside it.

    Only what is drawn is in it: the scene's messages and viser's page, none of which needs a network.

    Args:
        server: whose scene it is.
        solved: what the scene shows.
        name: of the variant.
        dark: whether the page is.
        position: of the camera at first, m.
        look_at: what it looks at first, m.
    """
    vehicle = solved.now.prepared.vehicle
    page = named_page(
        recorded_page(server, dark, position, look_at).encode(),
        f"{vehicle.name}: {solved.movement.title}",
    )
    beside = (
        f"<style>{style_sheet()}{_file('offline.css')}</style><aside>{_content(solved, name)}</aside>"
        f"<script>({_file('offline.js').rstrip().rstrip(';')})({json.dumps(DRIVER)},"
        f"{json.dumps(solved.movement.is_still)});</script>"
    )
    before, end, after = page.rpartition(b"</body>")
    return before + beside.encode() + end + after


def _content(solved: Solved, name: str) -> str:
    vehicle, moving = solved.now.prepared.vehicle, solved.movement
    return block(
        f"<h1>{title(moving.heading)}</h1>",
        f'<p class="dim">{escape(vehicle.name)}, {escape(name)}; {escape(moving.about)}</p>',
        color_scale_text(color_scale(solved)),
        MOTION,
        _charts(solved),
        f"<h2>Modes</h2>{_modes(solved)}",
        _rates(solved),
    )


MOTION = """<form class="motion" onsubmit="return false">
<label for="amplitude">Amplitude</label>
<input id="amplitude" name="amplitude" type="range" min="0" max="3" step="0.05" value="1">
<label for="speed">Speed</label>
<input id="speed" name="speed" type="range" min="0" max="2" step="0.05" value="0.5">
<label for="phase">Phase</label>
<input id="phase" name="phase" type="range" min="0" max="360" step="5" value="0">
<button name="play" type="button">Pause</button></form>"""


def _charts(solved: Solved) -> str:
    """The responses that the page draws, and what their colours mean."""
    responses = Responses(solved)
    lines = chart_lines(solved, responses, BASE, NOW_COLOR)
    charts = (_chart(solved, responses, lines, curve) for curve in solved.state.charts.curves)
    return legend(lines, solved) + "".join(charts)


def _chart(solved: Solved, responses: Responses, lines: Sequence[Line], response: ChartCurve) -> str:
    state, vehicle = solved.state, solved.now.prepared.vehicle
    shown = shown_hz(vehicle.highest_frequency)
    scale = Scale(responses.quantity_of(response), state.charts.decibels, state.charts.log_frequency)
    names = [state.against, *responses.overlaid, NOW]
    every = [(responses.lines(name), responses.of(name, response)) for name in names]
    decibels = [scale.quantity.decibels(level) for _, level in every]
    curves = [
        Curve("", f, db if state.charts.decibels else level, line.color, line.thickness, dash=line.dash)
        for line, (f, level), db in zip(lines, every, decibels, strict=True)
        if not np.isnan(level).all()
    ]
    curves[-1] = replace(curves[-1], peaks=strongest(responses, response, solved))
    inside = [db[(f >= shown[0]) & (f <= shown[1])] for (f, _), db in zip(every, decibels, strict=True)]
    label = curve_label(vehicle, response)
    chart = line_chart(
        curves,
        Axis("Frequency, Hz", *shown, state.charts.log_frequency),
        level_axis(scale, *level_range(np.concatenate(inside))),
        label if isinstance(response, ForceCurve) else f"Acceleration, {label}",
        width=420,
        height=190,
    )
    return f"<h2>{escape(label)}</h2>{chart}"


def _modes(solved: Solved) -> str:
    rows = []
    for mode, (name, f) in listed(solved.now).items():
        moved = span(moved_by(solved, mode), "dim")
        zeta = f"{100 * solved.now.modes.damping_ratio[mode]:.1f}"
        rows.append(row([title(name.spoken), f"{f:.2f}", moved, zeta], mode == solved.followed.mode))
    return table(("Mode", "Hz", "Δ Hz", "ζ %"), rows)


def _rates(solved: Solved) -> str:
    """The rates that are tuned, a table for each quantity."""
    groups = solved.now.prepared.vehicle.mount_groups
    return "".join(_rate_table(solved, *section) for section in sections(fields_of_groups(groups)))


def _rate_table(solved: Solved, kind: str, fields: Sequence[str]) -> str:
    """The rates of one quantity, with their changes, of the groups that are tuned in it."""
    unit = solved.state.units[quantity(fields[0])]
    per_unit = factor(unit, quantity(fields[0]))
    rows = []
    for group in solved.now.prepared.vehicle.mount_groups:
        if not set(fields).isdisjoint(group.fields):
            now = solved.now.rates[group.name]
            base = solved.base.rates.get(group.name, now)
            cells = (_rate_cell(getattr(now, f), getattr(base, f), per_unit) for f in fields)
            rows.append(row([escape(group.name), *cells]))
    listing = table(("Group", *map(direction, fields)), rows)
    return f"<h2>{kind or 'Mount rates'}, {unit}</h2>{listing}"


def _rate_cell(rate: float, before: float, per_unit: float) -> str:
    """A rate, and how much it differs from another."""
    change = f" {span(signed(100 * (rate / before - 1), 0, ' %'), 'dim')}" if before else ""
    return f"{rate / per_unit:.4g}" + (change if rate != before else "")


def _file(name: str) -> str:
    return files("modeviz.viewer").joinpath(name).read_text("utf-8")
