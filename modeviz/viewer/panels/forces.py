"""Right column, lower part: the force of every mount, over the band and where the cursor is."""

from collections.abc import Sequence
from html import escape

import numpy as np
import viser

from modeviz.analysis.mount_forces import figures_of
from modeviz.errors import ModevizError
from modeviz.mounting.forces import N_MOTIONS
from modeviz.text.markup import NONE
from modeviz.text.wording import number, percent_change, significant
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import MOTIONS, Mount
from modeviz.viewer.page.binding import Binding
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import (
    block,
    heading,
    hinted,
    named,
    row,
    span,
    table,
    title,
)
from modeviz.viewer.page.widgets.named_buttons import NamedButtons
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import ChangeCharts, SelectGroup
from modeviz.viewer.session.responses import Responses
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.wheel_responses import NOW

AXES = {"Of each mount": False, "Of the vehicle": True}
ALONG, ABOUT = range(3), range(3, N_MOTIONS)
UNITS = {ALONG: "N", ABOUT: "N m"}


class ForcesPanel:
    """RMS of every mount's force, or its largest amplitude, and what it is at the cursor."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Makes room; `show` fills it."""
        self._session = session
        self._mounts: Sequence[Mount] = session.vehicle.mounts
        self._binding: Binding | None = None
        if any(not np.array_equal(mount.axes, np.eye(3)) for mount in self._mounts):
            self._binding = _axes_choice(gui, session)
        self._buttons = NamedButtons[str](gui, self._select)
        self._content = gui.add_html("")

    def show(self, solved: Solved) -> None:
        """Draws the forces of an answer."""
        if self._binding:
            self._binding.show()
        self._mounts = solved.now.prepared.vehicle.mounts
        self._buttons.keep([mount.group for mount in self._mounts])
        try:
            content = [*self._over_band(solved), *self._at_cursor(solved)]
        except ModevizError as error:
            content = [span(escape(str(error)), "dim")]
        assign(self._content, content=block(*content))

    def _select(self, group: str) -> None:
        self._session.do(SelectGroup(group))

    def _over_band(self, solved: Solved) -> list[str]:
        """A table of RMS under a random load, of the largest amplitudes under a harmonic one."""
        responses = Responses(solved)
        axes = solved.state.charts.in_vehicle_axes
        found = [responses.mount_forces(name) for name in (NOW, solved.state.against)]
        values = [
            figures_of(self._mounts, each.vehicle, each.vehicle_figures if axes else each.figures)
            for each in found
        ]
        what = "RMS" if responses.harmonic_load is None else "Largest peak"
        shaking = title(solved.state.charts.load or solved.now.conditions.road)
        tables = []
        for motions in (ALONG, ABOUT):
            if values[0][:, motions].any():
                cells = [_compared(*pair) for pair in zip(*values, strict=True)]
                told = hinted(f"{what}, {UNITS[motions]}", "On the body that carries the mount")
                quiet = f"{shaking}, change to {escape(solved.state.against)}"
                tables += [heading(told, quiet), self._table(solved, cells, motions)]
        return tables

    def _at_cursor(self, solved: Solved) -> list[str]:
        """A table of amplitudes at the cursor's frequency, with phases under a harmonic load."""
        forces, spectra, _ = solved.cursor.solve(solved.state, solved.now)
        every = forces.in_vehicle_axes if solved.state.charts.in_vehicle_axes else forces.force
        n = N_MOTIONS * len(self._mounts)
        is_random = Responses(solved).harmonic_load is None
        levels = np.sqrt(spectra.psd(every[:, :n])[0]).reshape(-1, N_MOTIONS)
        phasors = every[0, :n, 0].reshape(-1, N_MOTIONS)
        cells = [
            [_at_line(*pair, is_random) for pair in zip(*both, strict=True)]
            for both in zip(levels, phasors, strict=True)
        ]
        unit = "/√Hz" if is_random else ", phase to the load"
        tables = []
        for motions in (ALONG, ABOUT):
            if levels[:, motions].any():
                told = f"At {solved.state.charts.cursor_hz:.2f} Hz, {UNITS[motions]}{unit}"
                tables += [heading(told), self._table(solved, cells, motions)]
        return tables

    def _table(self, solved: Solved, cells: list[list[str]], motions: range) -> str:
        """A row for each mount; a click on its name selects its group."""
        rows = [
            row(
                [self._name(mount), *(cells[i][m] for m in motions)],
                chosen=mount.group == solved.state.group,
            )
            for i, mount in enumerate(self._mounts)
            if any(cells[i][m] != NONE for m in motions)
        ]
        return table(("", *(MOTIONS[m] for m in motions)), rows, "forces")

    def _name(self, mount: Mount) -> str:
        return self._buttons.label(mount.group, named(mount.name, f"{mount.name}: its group's rates"))


def _compared(now: Floats, base: Floats) -> list[str]:
    """A cell for each motion: the value, and how much more it is than before."""
    return [_changed(float(n), float(b)) for n, b in zip(now, base, strict=True)]


def _changed(now: float, base: float) -> str:
    if not now and not base > 0:
        return NONE
    if np.isnan(base):
        return f"{significant(float(f'{now:.3g}'))} {span('new', 'dim')}"
    change = percent_change(now, base)
    more = "" if change == "0.0 %" else f" {span(change, 'dim')}"
    return f"{significant(float(f'{now:.3g}'))}{more}"


def _at_line(level: float, phasor: Complexes, is_random: bool) -> str:
    if not level:
        return NONE
    amplitude = significant(float(f"{level:.3g}"))
    if is_random:
        return amplitude
    return f"{amplitude} {span(number(float(np.degrees(np.angle(phasor))), 0) + '°', 'dim')}"


def _axes_choice(gui: viser.GuiApi, session: Session) -> Binding:
    labels = {value: label for label, value in AXES.items()}
    choice = gui.add_dropdown(
        "Axes",
        tuple(AXES),
        initial_value=labels[session.state.charts.in_vehicle_axes],
        hint="Along and about which axes forces are told",
    )
    return Binding(
        choice,
        session,
        lambda state: labels[state.charts.in_vehicle_axes],
        lambda label: session.do(ChangeCharts(in_vehicle_axes=AXES[label])),
    )
