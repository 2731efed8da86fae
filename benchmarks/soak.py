"""`python -m benchmarks.soak`: the truck's page used at random for minutes.

Nothing may fail in server or page, the server's memory may hardly grow, and at the end the page must
show what a fresh solve of its rates gives: the same numbers, curves and shape.
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
from threadpoolctl import threadpool_limits

from benchmarks.monkey import Monkey
from benchmarks.screen import is_drawn
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, Results, solve
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.ride.psd import power_decibels
from modeviz.shapes.motion import displacement, vertex_shapes
from modeviz.shapes.surface import surface
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.app import App
from modeviz.viewer.page.server import Server, open_server
from modeviz.viewer.pictures.headless import chromium
from modeviz.viewer.session.commands.looks import ChangeCharts, ChangeMotion, ChooseCurve
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import ResponseCurve

WARM_UP = 200
"""The number of actions after which memory is first looked at: until then caches fill."""

MAY_GROW_MB = 50.0

PATIENCE_S = 120.0
FAILED = "Not solved"
"""How the notice of an answer that failed begins."""

AGREE_MAC = 1e-6
"""What the MAC of drawn and solved shape may miss; the shape travels in 11 bits."""

WIDGETS = """
uuids => uuids.map((uuid) => {
  const element = document.getElementById(uuid);
  if (!element || !element.getBoundingClientRect().width) return null;
  if (element.type === "checkbox") return element.checked;
  if (element.tagName === "INPUT") return element.value;
  return Number(element.querySelector("[role=slider]")?.ariaValueNow ?? NaN);
})
"""
HALVES = """
path => {
  let found;
  window.__viserMutable.nodeRefFromName[path].traverse((object) => {
    found ??= object.geometry?.attributes?.modevizReal?.array;
  });
  return Array.from(found);
}
"""
CHARTS = "Object.values(window.__viserTestpoints.uplots).map(c => c.chart.data.map(d => Array.from(d)))"


@dataclass
class Soak:
    """What came of it."""

    n_actions: int
    seconds: float = 0.0
    grown_mb: float | None = None
    """Of the process with the server, after the first `WARM_UP` actions."""
    failures: list[str] = field(default_factory=list)
    """Exceptions in the server, errors in the page."""
    disagreements: list[str] = field(default_factory=list)
    """Where page and solver differ at the end."""

    def judge(self, grown_mb: float) -> None:
        """Keeps by how much the server's memory has grown, which is a failure if it is too much."""
        self.grown_mb = grown_mb
        if grown_mb > MAY_GROW_MB:
            self.failures.append(
                f"memory: grown by {grown_mb:.0f} MB, at most {MAY_GROW_MB:.0f} MB may be"
            )

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
            page = browser.new_page(viewport={"width": 980, "height": 640})
            page.on("pageerror", lambda error: found.failures.append(f"page: {error}"))
            page.on("console", found.note)
            _use(page, server, found, seconds, seed)
            app.tasks.search.close()
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
    monkey, memory = Monkey(page, seed), None
    begin = time.perf_counter()
    for i in range(found.n_actions):
        notices = monkey.act()
        found.failures += [notice for notice in notices if FAILED in notice]
        if i == WARM_UP:
            memory = _memory_mb()
        page.wait_for_timeout(max(0.0, 1000 * (seconds * (i + 1) / found.n_actions - _since(begin))))
    found.seconds = _since(begin)
    if memory is not None:
        found.judge(_memory_mb() - memory)


def _disagreements(page: Page, server: Server, session: Session) -> list[str]:
    """Where the page shows something else than the server has, or a fresh solve gives."""
    curves = (ResponseCurve(0, "lateral"), ResponseCurve(0, "vertical"))
    session.do(ChangeCharts(load="", decibels=True, log_frequency=False))
    for chart, curve in enumerate(curves):
        session.do(ChooseCurve(chart, curve))
    session.do(ChangeMotion(kind="mode"))
    if not session.wait_checked(PATIENCE_S):
        return ["the session does not come to rest"]
    page.wait_for_timeout(2000)
    fresh = solve(prepare(session.vehicle), session.state.design.rates, session.state.conditions)
    return [
        *_widgets(page, server),
        *_spectra(page, fresh),
        *_shape(page, fresh, session.state.motion.mode),
    ]


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
    if isinstance(value, tuple):  # the first of its boxes has the widget's name
        value = value[0]
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return shown != "" and abs(float(str(shown)) - value) <= 1e-6 * max(1.0, abs(value))
    return value == shown


def _spectra(page: Page, fresh: Results) -> list[str]:
    charts = page.evaluate(CHARTS)
    wrong = []
    for direction in ("lateral", "vertical"):
        curve = power_decibels(fresh.response(0, direction))
        if not any(is_drawn(fresh.frequency_hz, curve, chart) for chart in charts):
            wrong.append(f"no chart shows the {direction} spectrum of a fresh solve as the present one")
    return wrong


def _shape(page: Page, fresh: Results, mode: str) -> list[str]:
    """Whether flexible bodies are drawn in the mode of a fresh solve, whatever its scale and sign."""
    index = fresh.mode_index(mode)
    if index is None:  # another was followed
        return []
    q, system = fresh.modes.shapes[:, index], fresh.prepared.system
    bodies = [b for b in fresh.prepared.vehicle.bodies if isinstance(b, FlexibleBody)]
    halves = [page.evaluate(HALVES, f"/vehicle/{body.name}") for body in bodies]
    drawn = [np.array(bits, np.uint16).view(np.float16).astype(float) for bits in halves]
    shapes = [vertex_shapes(body, surface(body.mesh).vertices) for body in bodies]
    solved = [displacement(s, q[system.dofs[b.name]]) for b, s in zip(bodies, shapes, strict=True)]
    mac = _mac(np.concatenate(drawn), np.concatenate([each.ravel() for each in solved]))
    return [] if mac > 1 - AGREE_MAC else [f"{mode!r} is drawn with a MAC of {mac:.7f} to fresh"]


def _mac(one: Floats, other: Floats) -> float:
    return float((one @ other) ** 2 / ((one @ one) * (other @ other)))


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
    with threadpool_limits(limits=1, user_api="blas"):  # as `modeviz view` does
        found = soak(vehicle, options.actions, 60 * options.minutes, options.seed)
    grown = "not judged" if found.grown_mb is None else f"{found.grown_mb:+.1f} MB"
    print(
        f"{found.n_actions} actions in {found.seconds / 60:.1f} min, memory {grown}, "
        f"{len(found.failures)} failures"
    )
    wrong = list(dict.fromkeys([*found.failures, *found.disagreements]))
    print("\n".join(wrong) or "page and solver agree")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
