"""Right column: what excites the vehicle, and the scales of the charts."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import viser

from modeviz.text.wording import sentence_case, told_apart
from modeviz.units import factor
from modeviz.vehicle.engine import EngineOrder
from modeviz.vehicle.loads import Road
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, span
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import ChangeCharts, Drive
from modeviz.viewer.session.cursor import has_ride
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

SPEEDS = (5, 200)
"""km/h: what is of interest."""

PER_KMH = factor("km/h", "speed")
ROAD = "Road"
LEVELS = {"Decibels": True, "Linear unit, logarithmic axis": False}
FREQUENCIES = {"Linear": False, "Logarithmic": True}


class ExcitationPanel:
    """Road or wheel load, which road, how fast; decibels or not, linear or logarithmic frequency."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls."""
        self._session = session
        self._bindings: list[Binding] = []
        vehicle = session.vehicle
        is_still = all(isinstance(load, Road) and load.is_even for load in vehicle.offered_loads)
        loads = {} if is_still else {ROAD: ""}
        loads |= {sentence_case(load.name): load.name for load in vehicle.swept_loads}
        self._add_choice(
            gui,
            "Excitation",
            loads,
            "The road, or a harmonic load: the charts then show peak accelerations",
            lambda state: state.charts.load,
            lambda load: session.do(ChangeCharts(load=load)),
        )
        if not is_still:
            self._add_road(gui, vehicle)
        self._about = gui.add_html("")
        self._add_choice(
            gui,
            "Level",
            LEVELS,
            "How the charts' accelerations are written",
            lambda state: state.charts.decibels,
            lambda decibels: session.do(ChangeCharts(decibels=decibels)),
        )
        self._add_choice(
            gui,
            "Frequency",
            FREQUENCIES,
            "How the charts' frequencies are spaced",
            lambda state: state.charts.log_frequency,
            lambda is_log: session.do(ChangeCharts(log_frequency=is_log)),
        )

    def show(self, solved: Solved) -> None:
        """Brings the controls after the state."""
        show_all(self._bindings)
        assign(self._about, content=block(span(_about(solved), "dim")))

    def _add_road(self, gui: viser.GuiApi, vehicle: Vehicle) -> None:
        """Which road, and how fast."""
        self._add_choice(
            gui,
            "Road",
            told_apart(vehicle.offered_loads),
            "What is driven over, a class of road of ISO 8608, or another random load",
            lambda state: state.conditions.road,
            lambda road: self._session.do(Drive(road=road)),
        )
        self._add_speed(gui, _speed_limits(vehicle, self._session.state.conditions.speed))

    def _add_choice(
        self,
        gui: viser.GuiApi,
        label: str,
        values: dict[str, Any],
        hint: str,
        read: Callable[[State], Any],
        write: Callable[[Any], None],
    ) -> None:
        """A dropdown of values by what they are called."""
        labels = {value: text for text, value in values.items()}
        dropdown = gui.add_dropdown(
            label, tuple(values), initial_value=labels[read(self._session.state)], hint=hint
        )
        self._bindings.append(
            Binding(
                dropdown,
                self._session,
                lambda state: labels[read(state)],
                lambda text: write(values[text]),
            )
        )

    def _add_speed(self, gui: viser.GuiApi, limits: tuple[int, int]) -> None:
        slowest, fastest = limits

        def read(state: State) -> float:
            return float(min(max(round(state.conditions.speed / PER_KMH), slowest), fastest))

        slider = gui.add_slider(
            "Speed, km/h",
            min=float(slowest),
            max=float(fastest),
            step=1.0,
            initial_value=read(self._session.state),
            hint="The same road at another speed; the rear wheels follow the front ones sooner",
        )
        self._bindings.append(
            Binding(
                slider,
                self._session,
                read,
                lambda kmh: self._session.do(Drive(speed=kmh * PER_KMH)),
                WriteBack(),
            )
        )


def _about(solved: Solved) -> str:
    """Return the meaning of the choice."""
    name, vehicle = solved.state.charts.load, solved.now.prepared.vehicle
    load = vehicle.harmonic_load(name) if name else None
    if isinstance(load, EngineOrder):
        low, high = 60 * load.frequency_hz[[0, -1]] / load.order
        return f"As the engine runs from {low:.4g} to {high:.4g} rpm; all its orders: in Engine."
    if load is not None and not has_ride(vehicle):
        return "A force of the same size at every frequency."
    if load is not None:
        return "A force of the same size at every frequency; the road is for figures of sets only."
    return "The rear wheels meet the same road later, by wheelbase and speed."


def _speed_limits(vehicle: Vehicle, speed: float) -> tuple[int, int]:
    """The speeds, whole km/h within `SPEEDS`, at which every road's table holds something of the band.

    One more than that, where there is none but the present one, m/s: a slider needs two ends.
    """
    roads, band = vehicle.roads, vehicle.frequency_hz
    second, last_but_one = band[:2][-1], band[-2:][0]
    slowest = max((second / r.frequency_hz[-1] * r.speed for r in roads), default=0.0)
    fastest = min((last_but_one / r.frequency_hz[0] * r.speed for r in roads), default=np.inf)
    present = round(speed / PER_KMH)
    low = min(max(math.ceil(slowest / PER_KMH), SPEEDS[0]), present)
    high = max(math.floor(min(fastest / PER_KMH, SPEEDS[1])), present)
    return low, max(high, low + 1)
