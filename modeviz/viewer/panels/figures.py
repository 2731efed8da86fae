"""Right column: the four figures on top, and the table of all of them."""

from html import escape

import viser

from modeviz.analysis.engine_results import EngineResults
from modeviz.analysis.results import AXIS as ALONG
from modeviz.analysis.results import Results
from modeviz.report.coverage import band_text, coverage_note
from modeviz.report.tables import wheel_band
from modeviz.ride.psd import rms
from modeviz.text.wording import number, sentence_case, signed, significant
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import DIRECTIONS, RIDE_DIRECTIONS
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, change, heading, named, row, span, table
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.cursor import has_ride
from modeviz.viewer.session.responses import Responses
from modeviz.viewer.session.state import ResponseCurve
from modeviz.viewer.session.wheel_responses import NOW

DRIVER = 0
"""The response point that is rated: the vehicle's first."""

BAND = (11.0, 17.0)
"""Hz: where the paper's optimised mounts act on the lateral response."""

AXES = ("Fore-aft, Wd", "Lateral, Wd", "Vertical, Wk")
"""The weighted accelerations of ISO 2631-1, in the order of `Rating.weighted_rms`."""


NOTHING_FELT = (
    "Responses need what shakes and somewhere to feel it: give vehicle.toml a [[road]], an [[engine]] "
    "or a [[force]], and a [[response_point]]."
)


class FiguresPanel:
    """Four figures at the driver's point against the compared set."""

    def __init__(self, gui: viser.GuiApi) -> None:
        """Makes room; `show` fills it."""
        self._content = gui.add_html("")

    def show(self, solved: Solved, responses: Responses) -> None:
        """Draws the figures of an answer."""
        if not solved.state.charts.curves:
            assign(self._content, content=block(span(NOTHING_FELT, "dim")))
            return
        figures = _road_figures if responses.is_random else _wheel_figures
        if responses.running(NOW) is not None:
            figures = _engine_figures
        assign(self._content, content=block(figures(solved, responses)))


class TablePanel:
    """The figures of every response point and direction, and the weighted ones of the driver."""

    def __init__(self, gui: viser.GuiApi) -> None:
        """Makes room; `show` fills it."""
        self._content = gui.add_html(block(span("Figures follow with the first answer.", "dim")))

    def show(self, solved: Solved) -> None:
        """Lists the figures of an answer."""
        responses = Responses(solved)
        content = [_all_points(solved, responses)]
        if responses.is_random:
            content.append(_ratings(solved))
        elif has_ride(solved.now.prepared.vehicle):
            content.append(span("Ratings are those of a ride: choose the road again.", "dim"))
        assign(self._content, content=block(*content))


def _road_figures(solved: Solved, responses: Responses) -> str:
    """The rating and three RMS values."""
    base, now = solved.base, solved.now
    before, after = base.rating.mean_personal_rating, now.rating.mean_personal_rating
    gain = span(f"{signed(after - before, 2)} points", _kind(after - before))
    figures = [_figure("Ride rating", number(after, 2), "MPR", gain, _about_rating(now))]
    for direction in RIDE_DIRECTIONS:
        curve = ResponseCurve(DRIVER, direction)
        value, old = responses.figure(NOW, curve), responses.figure(solved.state.against, curve)
        about = f"RMS acceleration, {_point(now)}, {direction}, {band_text(now)}"
        label = f"RMS {direction}"
        figures.append(_figure(label, f"{value:.3f}", "g", change(value, old), about))
    value = _band_rms(now)
    label, about = f"Lat. {BAND[0]:g}–{BAND[1]:g} Hz", f"RMS lateral, {_point(now)}, in this band"
    figures.append(_figure(label, f"{value:.3f}", "g", change(value, _band_rms(base)), about))
    about_rating = f"Rating: {now.rating.note}" if now.rating.note else ""
    notes = (span(escape(note), "dim") for note in (coverage_note(now), about_rating) if note)
    return f'<div class="figures">{"".join(figures)}</div>' + "<br>".join(notes)


def _wheel_figures(solved: Solved, responses: Responses) -> str:
    """The means over the paper's band, and the highest lateral value in it."""
    against, now = solved.state.against, solved.now
    figures = []
    for direction in DIRECTIONS:
        curve = ResponseCurve(DRIVER, direction)
        value, old = responses.figure(NOW, curve), responses.figure(against, curve)
        about = f"Mean peak acceleration, {_point(now)}, {direction}, {_band_text(solved)}"
        label = f"Mean {direction}"
        figures.append(_figure(label, f"{1000 * value:.2f}", "10⁻³ g", change(value, old), about))
    lateral = ResponseCurve(DRIVER, "lateral")
    value, old = (
        _highest(solved, responses.lines(name), responses.of(name, lateral)) for name in (NOW, against)
    )
    about = f"Highest peak acceleration, {_point(now)}, lateral, {_band_text(solved)}"
    label = "Highest lateral"
    figures.append(_figure(label, f"{1000 * value:.2f}", "10⁻³ g", change(value, old), about))
    return f'<div class="figures">{"".join(figures)}</div>'


def _engine_figures(solved: Solved, responses: Responses) -> str:
    """The RMS of all orders at idle, and the largest vertical one of the run-up."""
    now = solved.now
    running, before = (responses.running(name) for name in (NOW, solved.state.against))
    assert running is not None
    assert before is not None
    figures = []
    for direction in DIRECTIONS:
        curve = ResponseCurve(DRIVER, direction)
        value, old = responses.figure(NOW, curve), responses.figure(solved.state.against, curve)
        about = f"RMS acceleration of all orders at idle, {_idle(running)}, {_point(now)}, {direction}"
        delta = change(value, old)
        figures.append(_figure(f"Idle {direction}", _milli(value), "10⁻³ g", delta, about))
    value, old = (float(r.rms[:, DRIVER, ALONG["vertical"]].max()) for r in (running, before))
    about = f"Largest RMS acceleration of all orders at any speed, {_point(now)}, vertical"
    figures.append(_figure("Highest vert.", _milli(value), "10⁻³ g", change(value, old), about))
    return f'<div class="figures">{"".join(figures)}</div>'


def _milli(acceleration: float) -> str:
    """An acceleration, g, in thousandths, to three digits."""
    return significant(float(f"{1000 * acceleration:.3g}"))


def _idle(running: EngineResults) -> str:
    return f"{60 * running.engine.idle_hz:.4g} rpm"


def _figure(label: str, value: str, unit: str, delta: str, about: str) -> str:
    return (
        f'<div title="{escape(about)}"><span>{label}</span>'
        f"<b>{value} <small>{unit}</small></b>{delta}</div>"
    )


def _all_points(solved: Solved, responses: Responses) -> str:
    """A row for each point and direction."""
    is_road, running = responses.is_random, responses.running(NOW)
    scale, decimals = (1, 4) if is_road else (1000, 2)
    rows = []
    for i, point in enumerate(solved.now.prepared.vehicle.response_points):
        for direction in DIRECTIONS:
            curve = ResponseCurve(i, direction)
            old, value = (responses.figure(n, curve) for n in (solved.state.against, NOW))
            name = named(sentence_case(point.name)) if direction == DIRECTIONS[0] else ""
            cells = [
                name,
                direction,
                span(f"{scale * old:.{decimals}f}", "dim"),
                f"{scale * value:.{decimals}f}",
                change(value, old),
            ]
            rows.append(row(cells))
    what = "RMS, g" if is_road else "Mean, 10⁻³ g"
    quiet = band_text(solved.now) if is_road else _band_text(solved)
    if running is not None:
        what, quiet = "RMS at idle, 10⁻³ g", _idle(running)
    header = ("Point", "", escape(solved.state.against), "now", "change")
    return heading(what, quiet) + table(header, rows)


def _ratings(solved: Solved) -> str:
    """The driver's rating and weighted values."""
    base, now = solved.base.rating, solved.now.rating
    weighted = zip(AXES, base.weighted_rms, now.weighted_rms, strict=True)
    rows = [_weighted(label, old, new) for label, old, new in weighted]
    rows.append(_weighted("Total, a<sub>v</sub>", base.weighted_total, now.weighted_total))
    gain = now.mean_personal_rating - base.mean_personal_rating
    cells = [
        "Mean personal rating",
        span(number(base.mean_personal_rating, 2), "dim"),
        number(now.mean_personal_rating, 2),
        span(signed(gain, 2), _kind(gain)),
    ]
    header = ("", escape(solved.state.against), "now", "change")
    return (
        heading("ISO 2631-1 weighted, m/s²", escape(_point(solved.now)))
        + table(header, rows)
        + heading("Ride rating", "10 is best")
        + f'<div title="{escape(_about_rating(solved.now))}">{table(header, [row(cells)])}</div>'
    )


def _weighted(label: str, old: float, new: float) -> str:
    return row([label, span(f"{old:.3f}", "dim"), f"{new:.3f}", change(new, old)])


def _point(results: Results) -> str:
    return sentence_case(results.prepared.vehicle.response_points[DRIVER].name)


def _band_text(solved: Solved) -> str:
    low, high = wheel_band(solved.now.prepared.vehicle)
    return f"{low:g} to {high:g} Hz"


def _band_rms(results: Results) -> float:
    """Return the RMS of the driver's lateral response within `BAND`, g."""
    return float(rms(results.frequency_hz, results.response(DRIVER, "lateral"), BAND))


def _highest(solved: Solved, f: Floats, levels: Floats) -> float:
    """Within the paper's band of wheel responses."""
    low, high = wheel_band(solved.now.prepared.vehicle)
    return float(levels[(f >= low) & (f <= high)].max())


def _about_rating(results: Results) -> str:
    return results.rating.note or "Mean personal rating of the driver, 10 is best"


def _kind(gain: float) -> str:
    return "dim" if abs(gain) < 0.005 else "good" if gain > 0 else "bad"
