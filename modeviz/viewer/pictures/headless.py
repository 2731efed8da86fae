"""A page that nobody looks at: a headless Chromium opens an open server to be photographed.

A page cannot photograph itself with its panels, and on the command line nobody has one open.
"""

import math
import shutil
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from importlib.util import find_spec
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

import viser

from modeviz.errors import ModevizError
from modeviz.vehicle.arrays import Floats
from modeviz.viewer.page.server import Server
from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.page.widgets.handles import nodes
from modeviz.viewer.pictures.pictures import Pose
from modeviz.viewer.scene.driver import PREFIX, ShapeDriver, held

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserType, ConsoleMessage, Page, Playwright

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
DRAWN_BY = "gl-egl" if sys.platform == "linux" else "swiftshader"
"""Mesa draws with the graphics card if there is one, else in software twice as fast as what Chromium
has of its own, SwiftShader, which it takes itself where there is no Mesa."""

FLAGS = (
    f"--use-angle={DRAWN_BY}",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
PATIENCE = 180.0
"""s: a large page takes long in software."""

MOST_PIXELS = 3840 * 2160
"""Of a window: a browser that draws in software takes fifty bytes for each."""

MARK = "modevizClient"
"""The name in a page's window under which it finds the server's number for it."""

DRAWN = """(nMeshes) => {
  const viewer = window.__viserMutable;
  viewer?.requestRender?.();
  const isShown = window.__modeviz?.nShown === nMeshes && window.__modevizLabels?.areDrawn;
  return isShown && Number(getComputedStyle(viewer.canvas).opacity) > 0.999;
}"""
"""Whether all meshes show their shapes, labels are in their places, and light has faded in."""

BARE = """
[data-dock-root] > :first-child { inset: 0 !important; }
[data-dock-root] > :not(:first-child) { display: none !important; }
"""
"""Leaves only the 3-D view of a page."""

UNSEEN = "window.__modevizUnseen = true"
"""Has the scene draw only what it is asked for; see driver.js."""

NOBODY = "try { localStorage.setItem('modeviz-visitor', '%s') } catch {}"
"""Has a page say that it is a browser of ours, and nobody who looks."""

NO_NOTICES = """() => {
  const buttons = document.querySelectorAll(".mantine-Notification-closeButton");
  buttons.forEach((button) => button.click());
  return !buttons.length;
}"""
STANDS_AT = """async (phase) => {
  const isHeld = window.__viserSceneTree.getState()["/_held"];
  if (!isHeld || window.__viserMutable.nodePoseData["/_held"]?.position[0] !== phase) return false;
  // Labels look for another camera once in a frame, and shadows follow it some frames later.
  const { scene, camera, requestRender } = window.__viserMutable;
  const places = () => {
    const matrices = [camera.matrixWorld.elements, camera.projectionMatrix.elements];
    scene.traverse(({ isLight, castShadow, matrixWorld }) => {
      if (isLight && castShadow) matrices.push(matrixWorld.elements);
    });
    return matrices.join();
  };
  for (let n = 0, before = ""; n < 6; n++) {
    requestRender();
    await new Promise(requestAnimationFrame);
    if (places() !== before) n = 0;
    before = places();
  }
  return window.__modevizLabels.areDrawn;
}"""


class HeadlessPage:
    """One page of a server in a headless Chromium, to be used in a `with` statement by one thread."""

    client: viser.ClientHandle
    """The page as the server sees it: `pictures.picture` and `pictures.cycle` take its scene."""
    hold: Callable[[float], None]
    """Lets the page stand at a phase, rad; it never moves by itself."""

    def __init__(
        self,
        server: Callable[[], Server],
        width: int = 900,
        height: int = 500,
        bare: bool = False,
        tick: Callable[[], None] = lambda: None,
    ) -> None:
        """Nothing is started yet.

        Args:
            server: gives an open one, for which the browser does not wait to be started.
            width: of the window, pixels.
            height: of the window, pixels.
            bare: whether the 3-D view has the window for itself, and is drawn in no frame but pictures.
            tick: called ten times a second while the page is waited for; what it raises ends that.
        """
        self._server, self._size, self._tick = server, (width, height), tick
        self._is_bare, self._n_stands = bare, 0
        self._reported: list[str] = []
        self._page: Page
        self._open = ExitStack()

    def __enter__(self) -> Self:
        """Opens the page and waits until its scene is drawn.

        Raises:
            ModevizError: Playwright or Chromium is missing, or the page was not drawn in time.
        """
        with ExitStack() as opening, _told_simply():
            browser = opening.enter_context(chromium())
            width, height = self._size
            self._page = browser.new_page(viewport={"width": width, "height": height})
            self._page.set_default_timeout(1000 * PATIENCE)
            self._page.on("pageerror", lambda error: self._reported.append(str(error)))
            self._page.on("console", self._note)
            self._page.add_init_script(NOBODY % self._server().visitors.own_key)
            if self._is_bare:
                self._page.add_init_script(UNSEEN)
            self._page.goto(f"{self._server().local_link}&fixedDpr=1")
            self.client = self._find_client()
            if self._is_bare:
                self._page.add_style_tag(content=BARE)
                self._until(lambda: self.client.camera.image_width == width)
            self.hold = opening.enter_context(held(self.client))
            self.hold(0.0)  # what moves is drawn again and again, which in software takes seconds
            self._wait_drawn()
            self._open = opening.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Closes the browser.

        Raises:
            RuntimeError: nothing else went wrong, but the page reported an error.
        """
        self._open.close()
        if error is None and self._reported:
            raise RuntimeError(f"the page reported: {self._reported[0]}")

    def page_png(self, like: viser.ClientHandle | None = None, phase: float = 0.0) -> bytes:
        """The whole page as a PNG file.

        Args:
            like: the page whose 3-D view this one's is to have, in size and camera.
            phase: θ at which the shapes stand, rad.
        """
        with _told_simply():
            if like is not None:
                self._fit(*_bounded(like.camera.image_width, like.camera.image_height))
                with self.client.atomic():
                    self.client.camera.position = like.camera.position
                    self.client.camera.look_at = like.camera.look_at
                    self.client.camera.fov = like.camera.fov
            self.stand(phase)
            self._wait(NO_NOTICES)
            self._wait_drawn()
            return self._page.screenshot(timeout=1000 * PATIENCE)

    def look(self, position: Floats, look_at: Floats) -> Pose:
        """Places the camera, m; for pictures that are taken after `stand`."""
        camera = self.client.camera
        camera.position, camera.look_at = position, look_at
        return Pose.of(camera)

    def stand(self, phase: float) -> None:
        """Waits until the page stands at a phase, rad, and has the camera it was given before."""
        self._n_stands += 1  # viser sends only what is new
        turned = phase + 2 * math.pi * self._n_stands
        self.hold(turned)  # goes the same way as the camera, after it
        self._wait(STANDS_AT, turned)

    def follow(self, driver: ShapeDriver) -> None:
        """Waits until the page, with all others, has the newest shapes."""
        driver.seek(0.0)  # goes the same way as the shapes, after them
        self._wait("(sought) => window.__modeviz?.sought === sought", driver.sought)

    def _fit(self, width: int, height: int) -> None:
        """Gives the window such a size that its 3-D view has this one, pixels."""
        n_fitting = 0
        for _ in range(20):  # the panels change their width with the window, a little later
            window, canvas = self._page.evaluate("[innerWidth, __viserMutable.canvas.clientWidth]")
            n_fitting = n_fitting + 1 if canvas == width else 0
            if n_fitting == 3:
                return
            self._page.set_viewport_size(
                {"width": max(window + width - canvas, 320), "height": max(height, 240)}
            )
            self._tick()
            self._page.wait_for_timeout(500)

    def _note(self, said: "ConsoleMessage") -> None:
        if said.type == "error":
            self._reported.append(said.text)

    def _find_client(self) -> viser.ClientHandle:
        """The page as the server sees it: each page is told its number, and this one asked for its."""

        def client() -> viser.ClientHandle | None:
            clients = self._server().get_clients()
            for number, page in clients.items():
                scripts.say(page, f"window.{MARK} = {number};")
            return clients.get(self._page.evaluate(f"window.{MARK} ?? null"))

        return self._until(client)

    def _wait_drawn(self) -> None:
        every = nodes(self._server().scene).items()
        # Their parents, which viser adds, stand at zero.
        meshes = [node for name, node in every if name.startswith(PREFIX + "/") and node.position[1]]
        self._wait(DRAWN, len(meshes))

    def _wait(self, condition: str, argument: float | None = None) -> None:
        """Waits until a JavaScript function is true."""
        self._until(lambda: self._page.evaluate(condition, argument))

    def _until(self, value: Callable[[], Any]) -> Any:
        """Waits until something is there or true, and gives it."""
        end = time.monotonic() + PATIENCE
        while not (found := value()):
            if time.monotonic() > end:
                raise ModevizError(f"the headless Chromium did not draw within {PATIENCE:.0f} s")
            self._tick()
            self._page.wait_for_timeout(100)
        return found


@contextmanager
def chromium() -> "Iterator[Browser]":
    """The system's Chromium, else Playwright's own; raises ModevizError if either is missing."""
    with _playwright() as playwright:
        own = playwright.chromium.executable_path
        path = next(filter(None, map(shutil.which, BROWSERS)), own)
        if not Path(path).exists():
            raise ModevizError(
                "pictures need Chromium: install your system's (apt install chromium), "
                "or Playwright's (playwright install chromium)"
            )
        browser = _launched(playwright.chromium, path)
        try:
            yield browser
        finally:
            browser.close()


@contextmanager
def _playwright() -> "Iterator[Playwright]":
    """Playwright; raises ModevizError if it is missing, or its Node.js does not run here."""
    if not find_spec("playwright"):
        raise ModevizError('pictures need Playwright: pip install "modeviz[pictures]"')
    from playwright.sync_api import sync_playwright

    try:
        playwright = sync_playwright().start()
    except Exception as error:
        raise ModevizError(
            f"pictures need Playwright, which does not start ({error}): see `playwright --version`; "
            "on Debian and Ubuntu it needs the package libatomic1"
        ) from error
    try:
        yield playwright
    finally:
        playwright.stop()


def _launched(kind: "BrowserType", path: str) -> "Browser":
    """A browser in its sandbox, where it can have one: root has none, nor have many containers."""
    from playwright.sync_api import Error

    try:
        return kind.launch(executable_path=path, args=FLAGS, chromium_sandbox=True)
    except Error:
        return kind.launch(executable_path=path, args=FLAGS, chromium_sandbox=False)


def _bounded(width: int, height: int) -> tuple[int, int]:
    """The size of a window, pixels, or a smaller one of its shape where that is too large to draw."""
    scale = min(1.0, math.sqrt(MOST_PIXELS / (width * height)))
    return math.floor(scale * width), math.floor(scale * height)


@contextmanager
def _told_simply() -> Iterator[None]:
    """Turns what Playwright raises into ModevizError."""
    try:
        yield
    except Exception as error:
        if not type(error).__module__.startswith("playwright"):
            raise
        first_line = str(error).splitlines()[0]
        raise ModevizError(f"the headless Chromium did not draw the page: {first_line}") from error
