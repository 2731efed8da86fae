"""Pictures without a page: the whole app opens where nobody looks, for as long as one file takes."""

import math
import secrets
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, wait
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal, TypeVar, get_args

from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError, located, quoted
from modeviz.report.comparison import RateSet
from modeviz.report.html import Picture
from modeviz.report.images import check_films, gif_bytes, mp4_bytes, png_bytes
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.app import App
from modeviz.viewer.page.access import open_server
from modeviz.viewer.panels.modes import listed
from modeviz.viewer.pictures.headless import HeadlessPage
from modeviz.viewer.pictures.pictures import (
    CYCLE_S,
    N_CYCLES,
    Cycle,
    ImageSettings,
    cycle_pictures,
    picture,
)
from modeviz.viewer.scene.stage import box, camera
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.coloring import ColorScale
from modeviz.viewer.session.commands.decisions import TakeRates
from modeviz.viewer.session.commands.looks import ChangeLook, SelectGroup, ShowMode
from modeviz.viewer.session.state import Coloring

T = TypeVar("T")
Kind = Literal["png", "gif", "mp4", "html"]
KINDS: Mapping[str, Kind] = {f".{kind}": kind for kind in get_args(Kind)}
"""By the ending of a file."""

OFFLINE_SIZE = (900, 800)
"""About the shape of the scene in an offline page, pixels."""

PATIENCE = 600.0
"""s: for one answer or picture, on a machine that has much else to do."""

WINDOW_PIXELS = 900 * 500
"""Of the page that draws: labels take as much of a picture as of its window."""


@dataclass(frozen=True)
class RenderRequest:
    """A picture that is asked for."""

    mode: str
    """Its name; "" is the one the page would open with."""
    view: str
    """One of `stage.VIEWS`."""
    coloring: Coloring
    amplitude: float
    """Of the motion, in parts of the usual one."""
    phase: float
    """θ of a still picture, rad."""
    n_frames: int
    """Of a cycle of a moving one."""


def render(
    vehicle: Vehicle,
    rates: Rates,
    conditions: Conditions,
    wish: RenderRequest,
    shot: ImageSettings,
    kind: Kind,
    tell: Callable[[str, float], None],
) -> bytes:
    """The content of a picture file.

    Args:
        vehicle: with the rates that all is compared with.
        rates: to show it with.
        conditions: of the plots in an offline page.
        wish: what is to be seen.
        shot: how.
        kind: of file.
        tell: told what is being done and the fraction of it that is done.

    Raises:
        ModevizError: there is no mode of that name, or what draws is missing or does not.
    """
    if kind == "mp4":
        check_films()
    with _app(vehicle, rates, conditions, shot.theme.is_dark) as app:
        size = OFFLINE_SIZE if kind == "html" else (shot.width, shot.height)
        seen = camera(box(vehicle), wish.view, *(100 * side for side in size))  # the card hides nothing
        if kind == "html":
            _first_answer(app, wish, tell)
            return app.offline(*seen)
        with (
            _beside(lambda: _first_answer(app, wish, tell)) as scale,
            HeadlessPage(app.server, *_window(shot), bare=True) as studio,
        ):
            shot = replace(shot, scale=scale())
            tell("drawing", 0.0)
            studio.follow(app.scene.driver)
            pose = studio.look(*seen)
            studio.stand(wish.phase)
            if kind == "png":
                return png_bytes(picture(studio.client, shot, pose, PATIENCE))
            cycle = Cycle(wish.n_frames, app.scene.driver.is_real)
            frames = cycle_pictures(
                studio.client,
                studio.hold,
                shot.moving(kind),
                pose,
                cycle,
                partial(tell, "drawing"),
                PATIENCE,
            )
            if kind == "gif":
                return gif_bytes(frames, cycle.order, CYCLE_S)
            return mp4_bytes(frames, cycle.order, CYCLE_S, N_CYCLES)


def photographs(
    vehicle: Vehicle,
    sets: Sequence[RateSet],
    conditions: Conditions,
    wish: RenderRequest,
    shot: ImageSettings,
    tell: Callable[[str, float], None],
) -> list[Picture]:
    """A still of a mode with each of several sets of rates; arguments and errors as `render`."""
    first = vehicle.all_rates(sets[0].rates)
    with (
        _app(vehicle, first, conditions, shot.theme.is_dark) as app,
        _beside(lambda: _first_answer(app, wish, tell)) as scale,
        HeadlessPage(app.server, *_window(shot), bare=True) as studio,
    ):
        with located(sets[0].name):
            shot = replace(shot, scale=scale())
        seen = camera(box(vehicle), wish.view, 100 * shot.width, 100 * shot.height)
        pose = studio.look(*seen)
        pictures = []
        for done, rate_set in enumerate(sets):
            tell("drawing", done / len(sets))
            app.session.do(TakeRates(vehicle.all_rates(rate_set.rates)))
            with located(rate_set.name):
                movement = _show(app, wish).movement
            studio.follow(app.scene.driver)
            studio.stand(wish.phase)
            caption = f"{movement.title}, {movement.frequency_hz:.2f} Hz, {rate_set.name}"
            pictures.append(Picture(caption, png_bytes(picture(studio.client, shot, pose, PATIENCE))))
        return pictures


@contextmanager
def _app(
    vehicle: Vehicle,
    rates: Rates,
    conditions: Conditions,
    dark: bool,
) -> Iterator[App]:
    """The app on a port that nobody knows, with a token."""
    server = open_server(port=0, token=secrets.token_urlsafe())
    try:
        app = App(vehicle, rates, conditions, server, dark)
    except ModevizError:
        server.stop()
        raise
    try:
        yield app
    finally:
        app.close()


def _first_answer(
    app: App, wish: RenderRequest, tell: Callable[[str, float], None]
) -> ColorScale | None:
    """Prepares the app and shows what is wished; gives the scale of its colours, see `App.pictured`."""
    app.start(lambda fraction: tell("preparing", fraction))
    scale = app.pictured(_show(app, wish))
    tell("opening", 0.0)
    return scale


@contextmanager
def _beside(work: Callable[[], T]) -> Iterator[Callable[[], T]]:
    """Does work in a thread; what this gives waits for its result.

    An error of ours in the meantime waits for its end, an interrupt does not.
    """
    future: Future[T] = Future()

    def run() -> None:
        try:
            future.set_result(work())
        except Exception as error:
            future.set_exception(error)

    threading.Thread(target=run, name="preparing", daemon=True).start()
    try:
        yield future.result
    except Exception:
        wait([future])
        raise


def _window(shot: ImageSettings) -> tuple[int, int]:
    """A window in which labels are as far apart as in the picture: of the same proportions, pixels."""
    scale = math.sqrt(WINDOW_PIXELS / (shot.width * shot.height))
    return round(scale * shot.width), round(scale * shot.height)


def _show(app: App, wish: RenderRequest) -> Solved:
    """Has the app show what is wished; raises ModevizError as `render`."""
    app.session.do(ChangeLook(coloring=wish.coloring))
    app.session.do(SelectGroup(""))
    if wish.mode:
        app.session.do(ShowMode(wish.mode))
    app.scene.driver.drive(amplitude=wish.amplitude)
    shown = app.session.wait_for_answer(PATIENCE)
    now = shown.now
    if wish.mode and now.mode_index(wish.mode) is None:
        names = ", ".join(name.name for name, _ in listed(now).values())
        raise ModevizError(f"unknown mode {quoted(wish.mode)}: there are {names}")
    return shown
