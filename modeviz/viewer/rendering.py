"""Pictures without a page: a scene opens where nobody looks, for as long as one file takes."""

import math
import secrets
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future, wait
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal, TypeVar, get_args

from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError, located, quoted
from modeviz.report.comparison import RateSet
from modeviz.report.html import Picture
from modeviz.report.images import check_films, gif_bytes, mp4_bytes, png_bytes
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.offline import offline_page
from modeviz.viewer.page.server import Server, open_server
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
from modeviz.viewer.scene.scene import Scene
from modeviz.viewer.scene.stage import box, camera
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.decisions import TakeDesign
from modeviz.viewer.session.commands.looks import ChangeLook, SelectGroup, ShowMode
from modeviz.viewer.session.design import variant_name
from modeviz.viewer.session.notifications import Answered, Notification
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import Coloring, first_state

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
    size = OFFLINE_SIZE if kind == "html" else (shot.width, shot.height)
    seen = camera(box(vehicle), wish.view, *(100 * side for side in size))  # the card hides nothing
    sets = (RateSet("", rates),)
    with _opening(vehicle, rates, conditions, shot.theme.is_dark) as scenery:
        if kind == "html":
            (solved,) = scenery().answers(sets, wish, tell)
            name = variant_name(vehicle, solved.state.design)
            return offline_page(scenery().server, solved, name, shot.theme.is_dark, *seen)
        with (
            _beside(lambda: scenery().answers(sets, wish, tell)) as answers,
            HeadlessPage(lambda: scenery().server, *_window(shot), bare=True) as studio,
        ):
            (solved,), scene = answers(), scenery().scene
            shot = replace(shot, scale=scene.color_scale(solved))
            tell("drawing", 0.0)
            studio.follow(scene.driver)
            pose = studio.look(*seen)
            studio.stand(wish.phase)
            if kind == "png":
                return png_bytes(picture(studio.client, shot, pose, PATIENCE))
            cycle = Cycle(wish.n_frames, scene.driver.is_real)
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
        _opening(vehicle, first, conditions, shot.theme.is_dark) as scenery,
        _beside(lambda: scenery().answers(sets, wish, tell)) as answers,
        HeadlessPage(lambda: scenery().server, *_window(shot), bare=True) as studio,
    ):
        scene = scenery().scene
        shot = replace(shot, scale=scene.color_scale(answers()[0]))
        seen = camera(box(vehicle), wish.view, 100 * shot.width, 100 * shot.height)
        pose = studio.look(*seen)
        pictures = []
        for done, (rate_set, solved) in enumerate(zip(sets, answers(), strict=True)):
            tell("drawing", done / len(sets))
            scene.show(solved)
            scene.place(solved.state)
            studio.follow(scene.driver)
            studio.stand(wish.phase)
            movement = solved.movement
            caption = f"{movement.title}, {movement.frequency_hz:.2f} Hz, {rate_set.name}"
            pictures.append(Picture(caption, png_bytes(picture(studio.client, shot, pose, PATIENCE))))
        return pictures


class Scenery:
    """A tuning session and its scene without panels, on a port that nobody knows, with a token."""

    def __init__(self, vehicle: Vehicle, rates: Rates, conditions: Conditions, dark: bool) -> None:
        """Nothing is solved yet; arguments as of `App`."""
        self.session: Session = Session(vehicle, first_state(vehicle, rates, conditions), self._hear)
        self.server: Server = open_server(port=0, token=secrets.token_urlsafe())
        self.server.gui.configure_theme(dark_mode=dark)
        self.scene: Scene = Scene(self.server, vehicle, dark, on_select=lambda _: None)

    def answers(
        self, sets: Sequence[RateSet], wish: RenderRequest, tell: Callable[[str, float], None]
    ) -> list[Solved]:
        """Prepare the vehicle, and return what is wished with each set; the scene shows the last.

        No more is asked of the session, which would check answers while pictures are drawn.

        Raises:
            ModevizError: as `render`.
        """
        self.session.start(lambda fraction: tell("preparing", fraction))
        self.session.do(ChangeLook(coloring=wish.coloring))
        self.session.do(SelectGroup(""))
        self.scene.driver.drive(amplitude=wish.amplitude)
        answers = []
        for rate_set in sets:
            with located(rate_set.name) if rate_set.name else nullcontext():
                answers.append(self._answer(rate_set, wish.mode))
        self.session.close()
        tell("opening", 0.0)
        return answers

    def close(self) -> None:
        """Ends the session and the server."""
        self.session.close()
        self.server.stop()

    def _answer(self, rate_set: RateSet, mode: str) -> Solved:
        rates = self.session.vehicle.all_rates(rate_set.rates)
        self.session.do(TakeDesign(rates, rate_set.placements))
        if mode:
            self.session.do(ShowMode(mode))
        solved = self.session.wait_for_answer(PATIENCE)
        now = solved.now
        if mode and now.mode_index(mode) is None:
            names = ", ".join(name.name for name, _ in listed(now).values())
            raise ModevizError(f"unknown mode {quoted(mode)}: there are {names}")
        return solved

    def _hear(self, notification: Notification) -> None:
        if isinstance(notification, Answered):
            self.scene.show(notification.solved)
            self.scene.place(notification.solved.state)


@contextmanager
def _opening(
    vehicle: Vehicle, rates: Rates, conditions: Conditions, dark: bool
) -> Iterator[Callable[[], Scenery]]:
    """Waits for the scenery, which opens beside."""
    with _beside(lambda: Scenery(vehicle, rates, conditions, dark)) as scenery:
        try:
            yield scenery
        finally:
            scenery().close()


@contextmanager
def _beside(work: Callable[[], T]) -> Iterator[Callable[[], T]]:
    """Does work in a thread; what this gives waits for its result.

    An error of ours in the meantime waits for its end, an interrupt does not.
    """
    future: Future[T] = Future()

    def run() -> None:
        try:
            future.set_result(work())
        except BaseException as error:  # whoever waits is to hear of any
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
