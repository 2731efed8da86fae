"""Left column: what it does that no two rubber parts are alike."""

import threading
from collections.abc import Callable, Mapping
from functools import partial
from html import escape

import viser

from modeviz.errors import ModevizError
from modeviz.report.records import Record
from modeviz.text.wording import number, significant
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS
from modeviz.viewer.page.widgets.alerts import refuse
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, heading, hinted, row, span, table, title
from modeviz.viewer.session.cursor import has_ride
from modeviz.viewer.session.session import Session
from modeviz.viewer.tasks.background_task import Job
from modeviz.viewer.tasks.scatter_task import HIGH, LOW, PERCENT, Built, ScatterOutcome, ScatterTask

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
                refuse(event.client, str(error))


def _text(job: Job[Built, ScatterOutcome], is_current: bool) -> list[str]:
    if job.phase == "failed":
        return [heading("Failed"), span(escape(job.failure), "bad")]
    if job.phase == "cancelled":
        return [heading("Cancelled")]
    if job.found is None:
        bar = f'<div class="bar"><i style="width:{job.done:.0%};background:var(--mv-now)"></i></div>'
        return [heading("Scattering", f"{100 * job.done:.0f} %"), bar]
    record = job.found.record
    n = f"{record['samples']} vehicles"
    quiet = n if is_current else f"{n}, other rates or road"
    return [heading("Scatter", quiet), _figures(record), _parts(record)]


def _figures(record: Record) -> str:
    """Return the bounds between which 90 of 100 stay, of the goal and the driver's ride."""
    quantities = record["quantities"]
    goal = hinted("Goal", escape(record["goal"]))
    rows = [_row(goal, quantities["goal"], significant)]
    rows += [_row(f"RMS {d}, g", quantities[f"rms_{d}_g"], significant) for d in RIDE_DIRECTIONS]
    rows.append(_row("Ride rating", quantities["mean_personal_rating"], partial(number, decimals=2)))
    return table(("", f"{PERCENT[0]:g} %", "as drawn", f"{PERCENT[1]:g} %"), rows)


def _row(label: str, values: Mapping[str, float], said: Callable[[float], str]) -> str:
    low, nominal, high = (values[key] for key in (LOW, "nominal", HIGH))
    return row([label, said(low), span(said(nominal), "dim"), said(high)])


def _parts(record: Record) -> str:
    """The parts that make most of the goal's spread, where there are vehicles enough to tell."""
    shares = {
        f"{each['mount']} {what}": each[key]
        for what, key in (("hardness", "hardness"), ("damping", "loss_factor"))
        for each in record["contributions"] or ()
    }
    most = sorted(shares, key=lambda name: shares[name], reverse=True)[:N_PARTS]
    rows = [row([title(name), f"{100 * shares[name]:.0f} %"]) for name in most]
    return table(("Most of the goal's spread", ""), rows) if rows else ""
