"""Right column, lower part: what of a response comes through which mount, where the cursor is."""

from html import escape

import numpy as np
import viser

from modeviz.analysis.latest import Latest
from modeviz.analysis.results import AXIS, Results
from modeviz.errors import ModevizError
from modeviz.mounting.paths import By, Path, Paths, solve_paths
from modeviz.text.wording import number, significant
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.mount_rates import DIRECTIONS
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import (
    block,
    heading,
    legend,
    named,
    row,
    span,
    table,
)
from modeviz.viewer.page.widgets.named_buttons import NamedButtons
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import ChangeCharts, SelectGroup
from modeviz.viewer.session.responses import Responses, curve_label
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import ResponseCurve

BY: dict[str, By] = {
    "Mount": "mount",
    "Direction of a mount": "direction",
    "Neighbouring body": "body",
    "Group": "group",
}
N_SHOWN = 14
"""The largest that are listed."""

LEAST_SHOWN = 0.005


class PathsPanel:
    """Bars of shares at the cursor, the largest first; a click selects the mount's group."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the choices and makes room; `show` fills it."""
        self._session = session
        vehicle = session.vehicle
        curves = {
            curve_label(vehicle, curve): curve
            for i in range(len(vehicle.response_points))
            for curve in (ResponseCurve(i, d) for d in DIRECTIONS)
        }
        labels = {curve: label for label, curve in curves.items()}
        ways = {by: label for label, by in BY.items()}
        state = session.state
        response = gui.add_dropdown(
            "Response",
            tuple(curves),
            initial_value=labels[state.charts.path_curve],
            hint="Whose paths are told: its body is cut free, and what joined it are forces on it",
        )
        by = gui.add_dropdown(
            "By",
            tuple(BY),
            initial_value=ways[state.charts.paths_by],
            hint="How paths are taken together",
        )
        self._bindings = (
            Binding(
                response,
                session,
                lambda state: labels[state.charts.path_curve],
                lambda label: session.do(ChangeCharts(path_curve=curves[label])),
            ),
            Binding(
                by,
                session,
                lambda state: ways[state.charts.paths_by],
                lambda label: session.do(ChangeCharts(paths_by=BY[label])),
            ),
        )
        self._base: Latest[tuple[Paths, Floats]] = Latest()
        self._own = {group.name for group in vehicle.mount_groups}
        self._buttons = NamedButtons[str](gui, self._select)
        self._buttons.keep([group.name for group in vehicle.mount_groups])
        self._content = gui.add_html("")

    def show(self, solved: Solved) -> None:
        """Draws the paths of an answer."""
        show_all(self._bindings)
        try:
            content = self._listing(solved)
        except ModevizError as error:
            content = [span(escape(str(error)), "dim")]
        assign(self._content, content=block(*content))

    def _listing(self, solved: Solved) -> list[str]:
        """Return a heading and the bars of an answer."""
        by = solved.state.charts.paths_by
        now, shares = _paths(solved, solved.now)
        key = solved.base, solved.state.charts, solved.state.conditions
        before = _shares_of(now, by, *self._base.get(key, lambda: _paths(solved, solved.base)))
        order = [i for i in np.argsort(-np.abs(shares)) if abs(shares[i]) >= LEAST_SHOWN][:N_SHOWN]
        largest = max([np.abs(shares).max(initial=0.0), np.abs(before).max(initial=0.0)]) or 1.0
        phasors = None if Responses(solved).harmonic_load is None else _acceleration(now)
        rows = []
        for i in order:
            group = _group(now.paths[i], by, self._own)
            name = named(now.paths[i].called(by), _about(now.paths[i], by))
            label = self._buttons.label(group, name) if group else name
            cells = [
                label,
                _bars(float(shares[i]), float(before[i]), largest),
                _percent(float(shares[i])),
                span(_percent(float(before[i])), "dim"),
            ]
            if phasors is not None:
                cells.append(span(_polar(complex(phasors[i])), "dim"))
            rows.append(row(cells, chosen=bool(group) and group == solved.state.group))
        colors = legend((("--mv-base", escape(solved.state.against)), ("--mv-now", "now")))
        what = f"Share of the response, {solved.state.charts.cursor_hz:.2f} Hz"
        none = span("Nothing moves this point there.", "dim")
        return [heading(what, colors), table((), rows, "energy") if rows else none]

    def _select(self, group: str) -> None:
        self._session.do(SelectGroup(group))


def _shares_of(now: Paths, by: By, other: Paths, shares: Floats) -> Floats:
    """The shares of another set's paths, for those of this one by what they are called, (n_paths,)."""
    known = {path.called(by): share for path, share in zip(other.paths, shares, strict=True)}
    return np.array([known.get(path.called(by), 0.0) for path in now.paths])


def _paths(solved: Solved, results: Results) -> tuple[Paths, Floats]:
    """The paths with some rates, taken together as is asked for, and their shares, (n_paths,)."""
    charts, system = solved.state.charts, results.prepared.system
    point = system.vehicle.response_points[charts.path_curve.point]
    forces, spectra, _ = solved.cursor.solve(solved.state, results)
    reading = system.motion(point.body, point.position)[AXIS[charts.path_curve.direction]]
    paths = solve_paths(forces, point.body, reading[system.dofs[point.body]])
    together = paths.together(charts.paths_by)
    return together, together.shares(spectra)[0]


def _acceleration(paths: Paths) -> Complexes:
    omega = 2 * np.pi * paths.frequency_hz[0]
    return -(omega**2) * paths.parts[0, :, 0] / STANDARD_GRAVITY


def _group(path: Path, by: By, own: set[str]) -> str:
    """The mount group that a click on a path selects; "" if it is none."""
    return path.group if by != "body" and path.group in own else ""


def _about(path: Path, by: By) -> str:
    """What to read where the pointer rests."""
    if by in ("mount", "direction") and path.body:
        return f"{path.called(by)}, from {path.body}"
    return path.called(by)


def _bars(now: float, base: float, largest: float) -> str:
    """The share now above the one before; what works against the others is red."""
    return "".join(
        f'<div class="bar" style="height:{height}px;margin-top:1px">'
        f'<i style="width:{100 * abs(share) / largest:.1f}%;background:var({color})"></i></div>'
        for share, height, color in (
            (now, 6, "--mv-bad" if now < 0 else "--mv-now"),
            (base, 3, "--mv-base"),
        )
    )


def _percent(share: float) -> str:
    return f"{number(100 * share, 0)} %"


def _polar(acceleration: complex) -> str:
    degrees = number(float(np.degrees(np.angle(acceleration))), 0)
    return f"{significant(float(f'{1000 * abs(acceleration):.3g}'))} mg {degrees}°"
