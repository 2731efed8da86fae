"""The cameras of all pages: framed on the vehicle or a part of it, and kept so."""

import threading
import time
from collections import Counter
from collections.abc import Callable

import numpy as np
import viser

from modeviz.errors import ModevizError
from modeviz.vehicle.arrays import Floats
from modeviz.viewer.page.people.looking import let_all_use
from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.page.widgets.html import FOR_ALL
from modeviz.viewer.scene.stage import FAR, FIELD_OF_VIEW, ISO, NEAR, VIEWS, Box, camera
from modeviz.viewer.session.view import CameraPose

UNTOUCHED = 2e-4
"""Of what is framed: a camera this close to where it was put has not been moved by anybody."""

GLIDE_STEPS, STEP_SECONDS = 16, 0.025

Pose = tuple[Floats, Floats]
"""Where a camera is and what it looks at, m."""


def add_view_buttons(gui: viser.GuiApi, look: Callable[[viser.ClientHandle, str], None]) -> None:
    """Builds the buttons for where to look from.

    Args:
        gui: where.
        look: turns a page's camera to one of `stage.VIEWS`.
    """
    gui.add_html(FOR_ALL)
    views = gui.add_button_group("View", tuple(VIEWS), hint="Where to look from")
    let_all_use(views)

    @views.on_click
    def _(event: viser.GuiEvent) -> None:
        if event.client is not None:
            look(event.client, views.value)


Left = Callable[[int, CameraPose | None], None]
"""Told the page whose camera was moved, and to where; None: the page keeps it framed by itself."""


def ignore_left(_client_id: int, _camera: CameraPose | None) -> None:
    """Keeps nothing of where cameras are."""


class Cameras:
    """Every page has its own camera; all of them look at the same."""

    def __init__(
        self,
        server: viser.ViserServer,
        box: Box,
        begin: CameraPose | None = None,
        is_led: Callable[[int], bool] = lambda _: False,
        left: Left = ignore_left,
    ) -> None:
        """Points the cameras of pages to come at a vehicle; their pictures' sizes are in CSS pixels.

        Args:
            server: of the pages.
            box: the space that is framed.
            begin: where cameras are at first; None: where all of that is seen.
            is_led: whether a page's camera goes where another one goes, and is left alone here.
            left: told where the camera of a page was left.
        """
        self._server, self._box, self._begin, self._is_led = server, box, begin, is_led
        self._left = left
        self._before = box
        self._is_framed = begin is None
        self._views: dict[int, tuple[str, Floats]] = {}
        self._lock = threading.RLock()  # pages tell of their cameras in several threads
        self._moves: Counter[int] = Counter()
        """How often each page's camera was sent somewhere; only the last counts."""
        initial = server.initial_camera
        if begin is None:
            initial.position, initial.look_at = camera(box, ISO, 1000, 1000)
        else:
            initial.position, initial.look_at = begin.position, begin.look_at
        initial.fov = FIELD_OF_VIEW
        initial.near, initial.far = NEAR * box.length, FAR * box.length
        scripts.run(server.scene, "page/browser/css_pixels.js")

        @server.on_client_connect
        def _(client: viser.ClientHandle) -> None:
            if begin is None:
                self.look(client, ISO)
            client.camera.on_update(lambda _: self._follow(client))

        @server.on_client_disconnect
        def _(client: viser.ClientHandle) -> None:
            self._views.pop(client.client_id, None)
            del self._moves[client.client_id]

    def look(self, client: viser.ClientHandle, view: str) -> None:
        """Turns a page's camera to one of `stage.VIEWS` of what is framed."""
        with self._lock:
            self._next_move(client)
            pose = self._framed(client, view)
            self._views[client.client_id] = view, pose[0]
            _put(client, pose)

    def frame(self, box: Box) -> None:
        """Glides all cameras, as turned as they are, to a space that fills their pictures."""
        if not self._is_framed:  # cameras that begin somewhere are where they should be
            self._is_framed, self._box = True, box
        if box == self._box:
            return
        self._before, self._box = self._box, box
        for client in self._server.get_clients().values():
            if self._is_led(client.client_id):
                continue
            move = self._next_move(client)
            threading.Thread(target=self._glide, args=(client, move), name="glide", daemon=True).start()

    def _next_move(self, client: viser.ClientHandle) -> int:
        """The number of a move that ends the glide before it."""
        self._moves[client.client_id] += 1
        return self._moves[client.client_id]

    def _glide(self, client: viser.ClientHandle, move: int) -> None:
        """Moves one camera until it is there or sent elsewhere."""
        begin = client.camera.position, client.camera.look_at
        end = self._target(client)
        for fraction in np.linspace(0, 1, GLIDE_STEPS + 1)[1:]:
            eased = fraction**2 * (3 - 2 * fraction)
            with self._lock:
                if move != self._moves[client.client_id]:
                    return
                _put(client, tuple(a + eased * (b - a) for a, b in zip(begin, end, strict=True)))
            time.sleep(STEP_SECONDS)

    def _target(self, client: viser.ClientHandle) -> Pose:
        """Return the end of a glide: framed as before, or aimed at the middle if somebody moved it."""
        position, look_at = client.camera.position, client.camera.look_at
        view, put = self._views.get(client.client_id, (ISO, position))
        was_sent = self._begin is None or client.client_id in self._views
        if was_sent and self._is_at(position, put):
            framed = self._framed(client, view)
            self._views[client.client_id] = view, framed[0]
            return framed
        closer = self._box.length / self._before.length
        return self._box.middle + closer * (position - look_at), self._box.middle

    def _framed(self, client: viser.ClientHandle, view: str) -> Pose:
        return camera(self._box, view, client.camera.image_width, client.camera.image_height)

    def _follow(self, client: viser.ClientHandle) -> None:
        """Keeps a camera framed that nobody has moved, and tells where it was left."""
        self._keep_framed(client)
        if not self._is_led(client.client_id):
            self._left(client.client_id, self._where_left(client))

    def _where_left(self, client: viser.ClientHandle) -> CameraPose | None:
        """Return where a camera is; None: where the page keeps it framed by itself.

        A page that opens tells of a place of viser's first, and then of that where pages begin.
        """
        position, look_at = client.camera.position, client.camera.look_at
        with self._lock:
            _, put = self._views.get(client.client_id, (ISO, None))
        if put is not None and self._is_at(position, put):
            return None
        if self._is_at(position, self._server.initial_camera.position):
            return self._begin
        return pose_of(position, look_at)

    def _keep_framed(self, client: viser.ClientHandle) -> None:
        """Looks again when the picture's shape has changed, unless somebody has moved the camera.

        viser puts the camera back where pages begin, even after it was framed if a page loads slowly.
        """
        with self._lock:
            if client.client_id not in self._views or self._is_led(client.client_id):
                return
            view, put = self._views[client.client_id]
            position, begin = client.camera.position, self._server.initial_camera.position
            is_untouched = self._is_at(position, put) or self._is_at(position, begin)
            if is_untouched and not self._is_at(position, self._framed(client, view)[0]):
                self.look(client, view)

    def _is_at(self, position: Floats, place: Floats) -> bool:
        return np.allclose(position, place, atol=UNTOUCHED * self._box.length)


def pose_of(position: Floats, look_at: Floats) -> CameraPose | None:
    """Return a camera's place; None of one that nobody can have."""
    try:
        (x, y, z), (to_x, to_y, to_z) = map(np.ndarray.tolist, (position, look_at))
        return CameraPose((x, y, z), (to_x, to_y, to_z))
    except ModevizError:
        return None


def _put(client: viser.ClientHandle, pose: Pose) -> None:
    with client.atomic():
        client.camera.position, client.camera.look_at = pose
