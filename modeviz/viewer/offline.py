"""One file that still moves without a server: the scene, and beside it what there is to read of it."""

import json
from html import escape
from importlib.resources import files

import viser
from viser import _messages

from modeviz.export.axes import Axis, decibel_axis
from modeviz.export.charts import BASE, Curve, line_chart
from modeviz.export.wording import signed
from modeviz.ride.psd import power_decibels
from modeviz.tuning.results import Results
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import DIRECTIONS, MountRates
from modeviz.viewer.answers import Solved
from modeviz.viewer.driver import DRIVER
from modeviz.viewer.handshake import named_page
from modeviz.viewer.html import block, row, span, style_sheet, table, title
from modeviz.viewer.panels.modes import listed
from modeviz.viewer.plots import SHOWN_HZ

POINT = 0
"""The response point that is drawn: the vehicle's first."""


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
    recording = server.get_scene_serializer()
    for message in (
        _messages.SetCameraPositionMessage(_three(position)),
        _messages.SetCameraLookAtMessage(_three(look_at)),
    ):
        recording._insert_message(message)
    vehicle = solved.now.prepared.vehicle
    page = named_page(recording.as_html(dark).encode(), f"{vehicle.name}: {solved.movement.title}")
    beside = (
        style_sheet()
        + f"<style>{_file('offline.css')}</style><aside>{_content(solved, name)}</aside>"
        + f"<script>({_file('offline.js').rstrip().rstrip(';')})({json.dumps(DRIVER)});</script>"
    )
    before, end, after = page.rpartition(b"</body>")
    return before + beside.encode() + end + after


def _content(solved: Solved, name: str) -> str:
    vehicle, moving = solved.now.prepared.vehicle, solved.movement
    conditions = solved.now.conditions
    speed = conditions.speed / factor("km/h", "speed")
    return block(
        f"<h1>{title(moving.title)}  {moving.frequency_hz:.2f} Hz</h1>",
        f'<p class="dim">{escape(vehicle.name)}, {escape(name)}; {escape(moving.about)}</p>',
        MOTION,
        *(_chart(solved, direction) for direction in DIRECTIONS),
        f'<p class="dim">{escape(conditions.road)}, {speed:.0f} km/h; in grey '
        f"{escape(solved.state.against)}</p>",
        f"<h2>Modes</h2>{_modes(solved.base, solved.now, solved.mode)}",
        f"<h2>Mount rates, N/mm</h2>{_rates(solved)}" if solved.state.rates else "",
    )


MOTION = """<form class="motion" onsubmit="return false">
<label for="amplitude">Amplitude</label>
<input id="amplitude" name="amplitude" type="range" min="0" max="3" step="0.05" value="1">
<label for="speed">Speed</label>
<input id="speed" name="speed" type="range" min="0" max="2" step="0.05" value="0.5">
<label for="phase">Phase</label>
<input id="phase" name="phase" type="range" min="0" max="360" step="5" value="0">
<button name="play" type="button">Pause</button></form>"""


def _chart(solved: Solved, direction: str) -> str:
    """The spectra at the driver's point, those compared with and the present ones."""
    f = solved.now.frequency_hz
    base, now = (power_decibels(r.response(POINT, direction)) for r in (solved.base, solved.now))
    inside = (f >= SHOWN_HZ[0]) & (f <= SHOWN_HZ[1])
    point = solved.now.prepared.vehicle.response_points[POINT].name
    heading = f"{point}, {direction}"
    curves = [Curve("now", f, now)]
    if solved.base.rates != solved.now.rates:
        curves.insert(0, Curve(solved.state.against, f, base, BASE, 1.5))
    chart = line_chart(
        curves,
        Axis("Frequency, Hz", *SHOWN_HZ),
        decibel_axis("dB re 1 g²/Hz", [base[inside], now[inside]]),
        f"Acceleration at the {heading}",
        width=420,
        height=190,
    )
    return f"<h2>{title(heading)}</h2>{chart}"


def _modes(base: Results, now: Results, shown: int) -> str:
    before = {name.name: f for name, f in listed(base).values()}
    rows = []
    for mode, (name, f) in listed(now).items():
        moved = signed(f - before[name.name], 2) if name.name in before else "new"
        zeta = f"{100 * now.modes.damping_ratio[mode]:.1f}"
        rows.append(row([title(name.spoken), f"{f:.2f}", span(moved, "dim"), zeta], mode == shown))
    return table(("Mode", "Hz", "Δ Hz", "ζ %"), rows)


def _rates(solved: Solved) -> str:
    base = solved.base.rates
    rows = [row([escape(group), *_rate_cells(r, base[group])]) for group, r in solved.now.rates.items()]
    return table(("Group", *DIRECTIONS), rows)


def _rate_cells(now: MountRates, base: MountRates) -> list[str]:
    per_mm = factor("N/mm", "stiffness")
    cells = []
    for rate, before in zip(now.as_tuple(), base.as_tuple(), strict=True):
        change = f" {span(signed(100 * (rate / before - 1), 0, ' %'), 'dim')}" if before else ""
        cells.append(f"{rate / per_mm:.4g}" + (change if rate != before else ""))
    return cells


def _file(name: str) -> str:
    return files("modeviz.viewer").joinpath(name).read_text("utf-8")


def _three(vector: Floats) -> tuple[float, float, float]:
    x, y, z = vector.tolist()
    return x, y, z
