"""`python -m benchmarks.soak`: the truck's page used at random for minutes.

Nothing may fail in server or page, the server's memory may hardly grow, and at the end the page must
show what a fresh solve of its rates gives.
"""

import argparse
import gc
import io
import resource
import sys
import time
from collections.abc import Sequence
from contextlib import redirect_stderr
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from playwright.sync_api import ConsoleMessage, Page

from benchmarks.monkey import Monkey
from modeviz.ride.psd import power_decibels
from modeviz.tuning.preparation import prepare
from modeviz.tuning.results import Conditions, solve
from modeviz.vehicle.files import builtin_vehicle, read_vehicle
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.app import App
from modeviz.viewer.doors import Server, open_server
from modeviz.viewer.headless import chromium
from modeviz.viewer.session import Session
from modeviz.viewer.state import Curve, State

WARM_UP = 0.1
"""The part of the actions after which memory is first looked at."""

PATIENCE_S = 120.0
AGREE_DB = 1e-6

WIDGETS = """
uuids => uuids.map((uuid) => {
  const element = document.getElementById(uuid);
  if (!element || !element.getBoundingClientRect().width) return null;
  if (element.type === "checkbox") return element.checked;
  if (element.tagName === "INPUT") return element.value;
  return Number(element.querySelector("[role=slider]")?.ariaValueNow ?? NaN);
})
"""
CHARTS = "Object.values(window.__viserTestpoints.uplots).map(c => c.chart.data.map(d => Array.from(d)))"


@dataclass
class Soak:
    """What came of it."""

    n_actions: int
    seconds: float = 0.0
    grown_mb: float = 0.0
    """Of the process with the server."""
    failures: list[str] = field(default_factory=list)
    """Exceptions in the server, errors in the page."""
    disagreements: list[str] = field(default_factory=list)
    """Where page and solver differ at the end."""

    def note(self, said: ConsoleMessage) -> None:
        """Keeps an error that the page's console shows."""
        if said.type == "error":
            self.failures.append(f"console: {said.text}")


def soak(vehicle: Vehicle, n_actions: int, seconds: float, seed: int = 1) -> Soak:
    """Uses a vehicle's page at random.

    Args:
        vehicle: whose.
        n_actions: how many things to do.
        seconds: over how long at least.
        seed: of the random choices.
    """
    found, printed = Soak(n_actions), io.StringIO()
    server = open_server(port=0)
    app = App(vehicle, vehicle.rates, Conditions(vehicle.roads[0].name, vehicle.speed), server)
    server.scene.configure_environment_map(None)  # in software it takes half a minute to draw
    try:
        app.start()
        with redirect_stderr(printed), chromium() as browser:
            page = browser.new_page(viewport={"width": 1280, "height": 720})
            page.on("pageerror", lambda error: found.failures.append(f"page: {error}"))
            page.on("console", found.note)
            _use(page, server, found, seconds, seed)
            found.disagreements = _disagreements(page, server, app.session)
    finally:
        app.close()
    if "Traceback" in printed.getvalue():  # of any thread of the server
        found.failures.append(printed.getvalue())
    return found


def _use(page: Page, server: Server, found: Soak, seconds: float, seed: int) -> None:
    page.set_default_timeout(1000 * PATIENCE_S)
    page.goto(f"http://127.0.0.1:{server.get_port()}/?fixedDpr=1")
    page.wait_for_function("document.querySelectorAll('.mantine-Slider-thumb').length > 2")
    monkey, memory = Monkey(page, seed), 0.0
    begin = time.perf_counter()
    for i in range(found.n_actions):
        monkey.act()
        if i == round(WARM_UP * found.n_actions):
            memory = _memory_mb()
        page.wait_for_timeout(max(0.0, 1000 * (seconds * (i + 1) / found.n_actions - _since(begin))))
    found.seconds, found.grown_mb = _since(begin), _memory_mb() - memory


def _disagreements(page: Page, server: Server, session: Session) -> list[str]:
    """Where the page shows something else than the server has, or a fresh solve gives."""
    curves = (Curve(0, "lateral"), Curve(0, "vertical"))
    session.change(load="", decibels=True, log_frequency=False, curves=curves, motion="mode")
    if not session.wait_checked(PATIENCE_S):
        return ["the session does not come to rest"]
    page.wait_for_timeout(2000)
    return [*_widgets(page, server), *_spectra(page, session.vehicle, session.state)]


def _widgets(page: Page, server: Server) -> list[str]:
    handles = server.gui._gui_input_handle_from_uuid
    shown = page.evaluate(WIDGETS, list(handles))
    wrong = []
    for handle, value in zip(handles.values(), shown, strict=True):
        if value is not None and not _is_same(handle.value, value):
            label = getattr(handle, "label", "")
            wrong.append(f"widget {label!r} shows {value!r}, the server has {handle.value!r}")
    return wrong


def _is_same(value: object, shown: object) -> bool:
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return abs(float(str(shown)) - value) <= 1e-6 * max(1.0, abs(value))
    return value == shown


def _spectra(page: Page, vehicle: Vehicle, state: State) -> list[str]:
    results = solve(prepare(vehicle), state.rates, state.conditions)
    charts = page.evaluate(CHARTS)
    wrong = []
    for direction in ("lateral", "vertical"):
        curve = power_decibels(results.response(0, direction))
        if not any(_is_drawn(results.frequency_hz, curve, chart) for chart in charts):
            wrong.append(f"no chart shows the {direction} spectrum of a fresh solve")
    return wrong


def _is_drawn(frequency_hz: np.ndarray, curve: np.ndarray, chart: list[list[float]]) -> bool:
    expected = np.interp(chart[0], frequency_hz, curve)
    return any(
        len(series) == len(expected)
        and np.allclose(np.array(series, float), expected, rtol=0, atol=AGREE_DB)
        for series in chart[1:]
    )


def _memory_mb() -> float:
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[1])
    return pages * resource.getpagesize() / 2**20


def _since(begin: float) -> float:
    return time.perf_counter() - begin


def main(arguments: Sequence[str] | None = None) -> int:
    """Uses the built-in truck's page, prints what came of it and returns 0 if that is nothing bad."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.soak", description=__doc__)
    parser.add_argument("--actions", type=int, default=2000, help="default 2000")
    parser.add_argument("--minutes", type=float, default=10.0, help="default 10")
    parser.add_argument("--seed", type=int, default=1, help="default 1")
    options = parser.parse_args(arguments)
    vehicle = read_vehicle(builtin_vehicle())
    found = soak(vehicle, options.actions, 60 * options.minutes, options.seed)
    print(
        f"{found.n_actions} actions in {found.seconds / 60:.1f} min, "
        f"{found.grown_mb:+.1f} MB, {len(found.failures)} failures"
    )
    wrong = [*found.failures, *found.disagreements]
    print("\n".join(wrong) or "page and solver agree")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
