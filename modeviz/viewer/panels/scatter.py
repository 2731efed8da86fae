"""Left column: what it does that no two rubber parts are alike."""

import threading
from html import escape

import numpy as np
import viser

from modeviz.analysis.results import AXIS
from modeviz.errors import ModevizError
from modeviz.report.optimum import objective_words
from modeviz.scatter.driving import Scattered
from modeviz.scatter.monte_carlo import Scatter, rating_of
from modeviz.text.wording import number, significant
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS
from modeviz.vehicle.problem import Problem
from modeviz.viewer.page.handles import assign
from modeviz.viewer.page.html import block, heading, hinted, row, span, table, title
from modeviz.viewer.session.cursor import has_ride
from modeviz.viewer.session.session import Session
from modeviz.viewer.tasks.background_task import Job
from modeviz.viewer.tasks.scatter_task import PERCENT, Build, ScatterOutcome, ScatterTask

SCATTER, CANCEL = "Scatter", "Cancel"
N_VEHICLES = 1000
VEHICLES = (300, 10_000)
N_PARTS = 3
"""So many parts are named that make most of the spread."""


class ScatterPanel:
    """A button that scatters the mounts at the present rates, and what came of it."""

    def __init__(self, gui: viser.GuiApi, session: Session, scatterer: ScatterTask) -> None:
        """Builds the controls; nothing where there is nothing to optimise for, or nobody to feel it."""
        self._session, self._scatterer = session, scatterer
        self._lock = threading.Lock()
        self._is_built = session.state.design.plan is not None and has_ride(session.vehicle)
        if not self._is_built:
            return
        with gui.add_folder("Scatter of parts"):
            self._count = gui.add_number(
                "Vehicles",
                N_VEHICLES,
                min=VEHICLES[0],
                max=VEHICLES[1],
                step=1,
                hint="How many are built of parts that differ: rates by up to ±15 %, loss factors by "
                "±30 %, the same ones every time",
            )
            self._buttons = gui.add_button_group(
                "Parts",
                (SCATTER,),
                hint="Solves them all at the present rates and shades, in the charts, what 90 of 100 "
                "stay between",
            )
            self._buttons.on_click(lambda event: self._press(event))
            self._text = gui.add_html("")

    def follow(self) -> None:
        """Draws where the scatter is; may be called in any thread."""
        if not self._is_built:
            return
        with self._lock:
            job = self._scatterer.job
            assign(self._buttons, options=(CANCEL,) if job and job.is_running else (SCATTER,))
            if job:
                is_current = job.asked.is_of(self._session.state)
                assign(self._text, content=block(*_text(job, is_current)))

    def _press(self, event: viser.GuiEvent) -> None:
        if self._buttons.value == CANCEL:
            self._scatterer.cancel()
            return
        try:
            self._scatterer.start(round(self._count.value))
        except ModevizError as error:
            if event.client:
                event.client.add_notification("Not possible", str(error), color="red")


def _text(job: Job[Build, ScatterOutcome], is_current: bool) -> list[str]:
    if job.phase == "failed":
        return [heading("Failed"), span(escape(job.failure), "bad")]
    if job.phase == "cancelled":
        return [heading("Cancelled")]
    if job.found is None:
        bar = f'<div class="bar"><i style="width:{job.done:.0%};background:var(--mv-now)"></i></div>'
        return [heading("Scattering", f"{100 * job.done:.0f} %"), bar]
    found = job.found.scatter
    n = f"{len(found.goal)} vehicles"
    quiet = n if is_current else f"{n}, other rates or road"
    return [heading("Scatter", quiet), _figures(job.asked.problem, found), _parts(job.found.told)]


def _figures(problem: Problem, found: Scatter) -> str:
    """Return the bounds between which 90 of 100 stay, of the goal and the driver's ride."""
    driver = found.rms[:, 0]
    goal = hinted("Goal", escape(objective_words(problem)))
    rows = [_row(goal, found.goal, found.nominal_goal)]
    for direction in RIDE_DIRECTIONS:
        axis = AXIS[direction]
        values, nominal = driver[:, axis], float(found.nominal_rms[0, axis])
        rows.append(_row(f"RMS {direction}, g", values, nominal))
    low, high = _between(found.mean_personal_rating)
    nominal = float(rating_of(found.nominal_rms[:1])[0])
    rows.append(row(["Ride rating", number(low, 2), span(number(nominal, 2), "dim"), number(high, 2)]))
    return table(("", f"{PERCENT[0]:g} %", "as drawn", f"{PERCENT[1]:g} %"), rows)


def _row(label: str, values: Floats, nominal: float) -> str:
    low, high = _between(values)
    return row([label, significant(low), span(significant(nominal), "dim"), significant(high)])


def _parts(told: Scattered) -> str:
    """The parts that make most of the goal's spread, where there are vehicles enough to tell."""
    if told.spread is None:
        return ""
    shares, parts = told.spread.shares, told.scatter.parts
    names = [f"{name} {what}" for what in ("hardness", "damping") for name in parts.names]
    most = np.argsort(-shares)[:N_PARTS]
    rows = [row([title(names[i]), f"{100 * shares[i]:.0f} %"]) for i in most]
    return table(("Most of the goal's spread", ""), rows)


def _between(values: Floats) -> tuple[float, float]:
    """The percentiles of `PERCENT`."""
    low, high = np.percentile(values, PERCENT)
    return float(low), float(high)
