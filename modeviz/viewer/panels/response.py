"""Right column, upper part: what the rates do to the ride."""

import math
from collections import Counter
from collections.abc import Sequence
from html import escape

import viser

from modeviz.export.wording import number, sentence_case, signed
from modeviz.ride.participation import Peak
from modeviz.ride.psd import rms
from modeviz.tuning.preparation import FREQUENCY_HZ
from modeviz.tuning.results import AXIS, Conditions, Results
from modeviz.units import factor
from modeviz.vehicle.loads import Road
from modeviz.viewer.answers import Solved
from modeviz.viewer.assign import assign
from modeviz.viewer.html import block, change, heading, span, title
from modeviz.viewer.plots import PsdPlot
from modeviz.viewer.session import Session
from modeviz.viewer.settle import WriteBack

DIRECTIONS = ("lateral", "vertical")
"""What is drawn at the driver's point, top down."""

SHORT = {"lateral": "Lat.", "vertical": "Vert."}

BAND = (11.0, 17.0)
"""Hz: where the paper's optimised mounts act on the lateral response."""

PEAK_BAND = (5.0, 25.0)
"""Hz: below it mounts do nothing (Duncan, "The requirement")."""

PEAK_GAP_HZ = 2.0
SPEEDS = (20, 160)
"""km/h: what is of interest."""

N_PEAKS = 2
N_CONTRIBUTORS = 3
DRIVER = 0
"""The response point that is shown: the vehicle's first."""


class ResponsePanel:
    """Four figures, the PSDs at the driver's point, and the modes in their peaks."""

    def __init__(self, gui: viser.GuiApi, session: Session, dark: bool) -> None:
        """Builds the charts; `show` fills them."""
        self._point = session.vehicle.response_points[DRIVER].name
        self._base: Results | None = None
        self._base_band_rms = 0.0
        self._figures = gui.add_html("")
        self._headings: dict[str, viser.GuiHtmlHandle] = {}
        self._plots: dict[str, PsdPlot] = {}
        for direction in DIRECTIONS:
            self._headings[direction] = gui.add_html("")
            self._plots[direction] = PsdPlot(gui, FREQUENCY_HZ, dark)
        gui.add_html(block(heading("Peaks and the modes in them", "click a mode to see it move")))
        self._peaks_hz: dict[str, list[float]] = {direction: [] for direction in DIRECTIONS}
        self._peaks = {
            (direction, i): PeakRow(gui, session) for direction in DIRECTIONS for i in range(N_PEAKS)
        }

    def show(self, solved: Solved) -> None:
        """Draws an answer."""
        base, now = solved.base, solved.now
        if base is not self._base:
            self._base, self._base_band_rms = base, _band_rms(base)
        if solved.is_detailed:
            assign(self._figures, content=block(_figures(base, self._base_band_rms, now)))
        for direction in DIRECTIONS:
            if solved.is_detailed:
                self._show_peaks(direction, now)
            assign(self._headings[direction], content=block(_heading(self._point, direction, now)))
            self._plots[direction].show(
                base.response(DRIVER, direction),
                now.response(DRIVER, direction),
                self._peaks_hz[direction],
            )

    def _show_peaks(self, direction: str, now: Results) -> None:
        """Names the modes in the strongest peaks."""
        peaks = now.peaks(DRIVER, direction, N_CONTRIBUTORS, strongest(now, direction))
        self._peaks_hz[direction] = [peak.frequency_hz for peak in peaks]
        for i in range(N_PEAKS):
            self._peaks[direction, i].show(direction, peaks[i] if i < len(peaks) else None, now)


class PeakRow:
    """One peak: a button for each of the modes that make it."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Makes an empty row."""
        self._modes: dict[str, str] = {}
        self._buttons = gui.add_button_group("-", ("-",), hint="Share of each mode, largest first")
        self._buttons.on_click(lambda _: self._select(session))

    def _select(self, session: Session) -> None:
        mode = self._modes.get(self._buttons.value)
        if mode is not None:  # else another answer came between the click and here
            session.show_mode(mode)

    def show(self, direction: str, peak: Peak | None, now: Results) -> None:
        """Shows a peak, or nothing."""
        assign(self._buttons, visible=peak is not None)
        if peak is None:
            return
        names = [now.names[c.mode] for c in peak.contributors]
        texts = [
            f"{sentence_case(name.spoken)} {c.ratio:.2f}"
            for name, c in zip(names, peak.contributors, strict=True)
        ]
        self._modes = {text: name.name for text, name in zip(texts, names, strict=True)}
        label = f"{SHORT[direction]} {peak.frequency_hz:.1f} Hz"
        assign(self._buttons, label=label, options=tuple(texts))


class RoadPanel:
    """Which road, and how fast."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls."""
        labels = _road_labels(session.vehicle.roads)
        start = session.state.conditions
        current = next(label for label, name in labels.items() if name == start.road)
        road = gui.add_dropdown(
            "Road", tuple(labels), initial_value=current, hint="What is driven over"
        )
        slowest, fastest = _speed_limits(session.vehicle.roads)
        at_first = min(max(round(start.speed / factor("km/h", "speed")), slowest), fastest)
        speed = gui.add_slider(
            "Speed, km/h",
            min=float(slowest),
            max=float(fastest),
            step=1.0,
            initial_value=float(at_first),
            hint="The same road at another speed; the rear wheels follow the front ones sooner",
        )
        write_back = WriteBack()

        def changed(event: viser.GuiEvent) -> None:
            if event.client is not None:
                write_back.touch(event.target)
                new = Conditions(labels[road.value], speed.value * factor("km/h", "speed"))
                session.change(conditions=new)

        road.on_update(changed)
        speed.on_update(changed)


def _heading(point: str, direction: str, now: Results) -> str:
    left = f"{title(point)}, {direction} {span('dB re 1 g²/Hz', 'dim')}"
    if direction == DIRECTIONS[0]:
        return heading(
            left,
            '<i class="swatch" style="background:var(--mv-base)"></i>original &nbsp; '
            '<i class="swatch" style="background:var(--mv-now)"></i>current',
        )
    speed = now.conditions.speed / factor("km/h", "speed")
    return heading(left, f"{escape(now.conditions.road)}, {speed:.0f} km/h")


def _road_labels(roads: Sequence[Road]) -> dict[str, str]:
    """The roads' names by what they are called on screen, with the name too where labels are alike."""
    count = Counter(road.label for road in roads)
    return {
        road.label if count[road.label] == 1 else f"{road.label} ({road.name})": road.name
        for road in roads
    }


def _speed_limits(roads: Sequence[Road]) -> tuple[int, int]:
    """The speeds, whole km/h within `SPEEDS`, at which every road's table holds the whole band."""
    slowest = max(FREQUENCY_HZ[-1] / road.frequency_hz[-1] * road.speed for road in roads)
    fastest = min(FREQUENCY_HZ[0] / road.frequency_hz[0] * road.speed for road in roads)
    per_kmh = factor("km/h", "speed")
    return max(math.ceil(slowest / per_kmh), SPEEDS[0]), min(math.floor(fastest / per_kmh), SPEEDS[1])


def strongest(results: Results, direction: str) -> list[int]:
    """The lines of the `N_PEAKS` highest peaks of the ride band that stand apart, rising."""
    f, psd = results.frequency_hz, results.response(DRIVER, direction)
    lines = [i for i in results.peak_lines(DRIVER, direction) if PEAK_BAND[0] <= f[i] <= PEAK_BAND[1]]
    chosen: list[int] = []
    for line in sorted(lines, key=lambda i: -psd[i]):
        if all(abs(f[line] - f[other]) > PEAK_GAP_HZ for other in chosen):
            chosen.append(line)
    return sorted(chosen[:N_PEAKS])


def _band_rms(results: Results) -> float:
    """Of the driver's lateral response within `BAND`, g."""
    return float(rms(results.frequency_hz, results.response(DRIVER, "lateral"), BAND))


def _figures(base: Results, base_band_rms: float, now: Results) -> str:
    """The rating and three RMS values with their change against the base."""
    rating, before = now.rating.mean_personal_rating, base.rating.mean_personal_rating
    better = span(f"{signed(rating - before, 2)} points", _kind(rating - before))
    figures = [("Ride rating", number(rating, 2), "MPR", better)]
    for direction in DIRECTIONS:
        axis = AXIS[direction]
        value, original = now.rms[DRIVER, axis], base.rms[DRIVER, axis]
        figures.append((f"Seat {direction}", f"{value:.3f}", "g", change(value, original)))
    value, label = _band_rms(now), f"Lat. {BAND[0]:g}–{BAND[1]:g} Hz"
    figures.append((label, f"{value:.3f}", "g", change(value, base_band_rms)))
    cells = "".join(
        f"<div><span>{label}</span><b>{value} <small>{unit}</small></b>{delta}</div>"
        for label, value, unit, delta in figures
    )
    return f'<div class="figures" title="{now.rating.note}">{cells}</div>'


def _kind(gain: float) -> str:
    return "dim" if abs(gain) < 0.005 else "good" if gain > 0 else "bad"
