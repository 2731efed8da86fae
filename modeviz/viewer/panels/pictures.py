"""Left column: pictures to take away."""

import math
import threading
from collections.abc import Callable, Iterator
from functools import partial
from itertools import count
from typing import Literal

import viser
from PIL import Image

from modeviz.report.images import check_films, gif_bytes, mp4_bytes, png_bytes
from modeviz.text.time_left import TimeLeft
from modeviz.text.wording import file_name
from modeviz.vehicle.arrays import Floats
from modeviz.viewer.page.server import Server
from modeviz.viewer.panels.downloads import Downloads
from modeviz.viewer.pictures.headless import HeadlessPage
from modeviz.viewer.pictures.pictures import (
    CYCLE_S,
    N_CYCLES,
    N_FRAMES,
    SIZES,
    Backdrop,
    Cycle,
    ImageSettings,
    Pose,
    cycle_pictures,
    picture,
    same_field_of_view,
)
from modeviz.viewer.scene.driver import held
from modeviz.viewer.scene.stage import Theme
from modeviz.viewer.session.coloring import ColorScale
from modeviz.viewer.tasks.page_jobs import Progress, turn

PRESETS = {
    "1920 × 1080": (1920, 1080),
    "1280 × 720": (1280, 720),
    "3840 × 2160": (3840, 2160),
    "1080 × 1080": (1080, 1080),
    "640 × 360": (640, 360),
}
BACKDROPS: dict[str, Backdrop] = {
    "As on screen": "scene",
    "White": "white",
    "Transparent": "transparent",
}

N_JOBS, N_BROWSERS = 8, 1
"""At once: each keeps pictures in memory, and a headless browser takes much more."""


class PicturePanel:
    """Chooses what is saved, how large and on which background, and saves it."""

    def __init__(
        self,
        gui: viser.GuiApi,
        server: Server,
        theme: Theme,
        subject: Callable[[], str],
        is_real: Callable[[], bool],
        scale: Callable[[], ColorScale | None],
        offline: Callable[[Floats, Floats], bytes] | None = None,
        report: Callable[[bytes], bytes] | None = None,
        taken: Callable[[bytes, str], None] = lambda png, kind: None,
    ) -> None:
        """Builds the controls.

        Args:
            gui: where.
            server: whose pages are photographed.
            theme: of the scene.
            subject: what is to be seen, after which files are named.
            is_real: tells whether the shape that is shown is real.
            scale: gives what the colours of bodies mean; raises ModevizError if nothing is drawn.
            offline: makes the file that needs no server, for a camera's place and what it looks at; if
                not given, there is none.
            report: makes the report of the comparison, for a picture of the scene as PNG; likewise.
            taken: given every picture of the scene as PNG that is saved, and with what.
        """
        self._server, self._theme = server, theme
        self._subject, self._is_real, self._scale = subject, is_real, scale
        self._taken = taken
        self.downloads: Downloads = Downloads(server, N_JOBS)
        self._browsers = threading.Semaphore(N_BROWSERS)
        self._makers: dict[str, tuple[str, str, Callable[[viser.ClientHandle, Progress], bytes]]] = {
            "Picture, PNG": ("", "png", self._picture),
            "Loop, GIF": ("", "gif", self._gif),
            "Film, MP4": ("", "mp4", self._mp4),
            "Whole page, PNG": ("page", "png", self._page),
        }
        if offline:
            self._makers["Offline page, HTML"] = "", "html", partial(_html, offline)
        if report:
            self._makers["Report, HTML"] = "report", "html", partial(self._illustrated, report)
        self._kind = gui.add_dropdown(
            "Save",
            tuple(self._makers),
            hint="The 3-D view as it is; one cycle of its motion; the page with its plots, opened anew "
            "with the first tab of each panel in front"
            + ("; a file that moves without a server" if offline else "")
            + ("; or the present rates compared with the chosen set" if report else ""),
        )
        preset = gui.add_dropdown("Size", tuple(PRESETS), hint="Width and height, pixels")
        first = PRESETS[preset.value]
        self._width, self._height = (
            gui.add_number(name, value, min=SIZES[0], max=SIZES[1], step=1, hint=f"{name}, pixels")
            for name, value in zip(("Width", "Height"), first, strict=True)
        )

        @preset.on_update
        def _(_: viser.GuiEvent) -> None:
            self._width.value, self._height.value = PRESETS[preset.value]

        self._backdrop = gui.add_dropdown(
            "Background", tuple(BACKDROPS), hint="Loops and films are never transparent, but white"
        )
        button = gui.add_button("Save…", icon=viser.Icon.CAMERA, hint="Makes the file and downloads it")
        button.on_click(lambda event: self._save(event.client))

    def _save(self, client: viser.ClientHandle | None) -> None:
        """Begins to make a file for a page."""
        kind = self._kind.value
        what, ending, make = self._makers[kind]

        def named(client: viser.ClientHandle, tell: Progress) -> tuple[str, bytes]:
            content = make(client, tell)
            return file_name(f"{self._subject()} {what}", ending), content

        self.downloads.begin(client, kind, named)

    def _shot(self, client: viser.ClientHandle) -> ImageSettings:
        width, height = round(self._width.value), round(self._height.value)
        fov = same_field_of_view(client.camera, width, height)
        return ImageSettings(
            width, height, BACKDROPS[self._backdrop.value], self._theme, fov, self._scale()
        )

    def _picture(self, client: viser.ClientHandle, tell: Progress) -> bytes:
        """The 3-D view at this moment."""
        png = self._photograph(client, tell)
        self._taken(png, "")
        return png

    def _photograph(self, client: viser.ClientHandle, tell: Progress) -> bytes:
        tell(0.0)
        return png_bytes(picture(client, self._shot(client), Pose.of(client.camera)))

    def _gif(self, client: viser.ClientHandle, tell: Progress) -> bytes:
        """One cycle that repeats without a seam."""
        cycle = self._cycle()
        return gif_bytes(self._frames(client, "gif", cycle, tell), cycle.order, CYCLE_S)

    def _mp4(self, client: viser.ClientHandle, tell: Progress) -> bytes:
        """Some cycles as a film."""
        check_films()
        cycle = self._cycle()
        frames = self._frames(client, "mp4", cycle, tell)
        return mp4_bytes(frames, cycle.order, CYCLE_S, N_CYCLES)

    def _cycle(self) -> Cycle:
        return Cycle(N_FRAMES, self._is_real())

    def _frames(
        self,
        client: viser.ClientHandle,
        ending: Literal["gif", "mp4"],
        cycle: Cycle,
        tell: Progress,
    ) -> Iterator[Image.Image]:
        """The pictures of what moves, while the page stands still."""
        shot, pose = self._shot(client).moving(ending), Pose.of(client.camera)
        left = TimeLeft()

        def tell_drawn(fraction: float) -> None:
            tell(fraction, left.words(fraction))

        with held(client) as hold:
            yield from cycle_pictures(client, hold, shot, pose, cycle, tell_drawn)

    def _page(self, client: viser.ClientHandle, tell: Progress) -> bytes:
        """The page with its panels, from a browser beside: no page can photograph itself."""
        done = count(1)

        def tick() -> None:
            tell(1 - math.exp(-next(done) / 100))  # nobody knows how long

        with turn(self._browsers, tell), HeadlessPage(lambda: self._server, tick=tick) as studio:
            return studio.page_png(like=client)

    def _illustrated(
        self, report: Callable[[bytes], bytes], client: viser.ClientHandle, tell: Progress
    ) -> bytes:
        """The comparison on paper."""
        png = self._photograph(client, tell)
        tell(0.5)
        self._taken(png, "Report: ")
        return report(png)


def _html(
    offline: Callable[[Floats, Floats], bytes], client: viser.ClientHandle, tell: Progress
) -> bytes:
    """The scene with its plots in a file."""
    tell(0.0)
    return offline(client.camera.position, client.camera.look_at)
