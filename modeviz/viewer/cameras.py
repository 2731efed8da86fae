"""The cameras of all pages: framed on the vehicle, kept so, and turned to what is followed."""

import threading
import time

import numpy as np
import viser

from modeviz.vehicle.arrays import Floats
from modeviz.viewer import scripts
from modeviz.viewer.stage import FIELD_OF_VIEW, ISO, Box, camera

UNTOUCHED = 1e-3
"""m: a camera this close to where it was put has not been moved by anybody."""

GLIDE_STEPS, STEP_SECONDS = 16, 0.025

Pose = tuple[Floats, Floats]
"""Where a camera is and what it looks at, m."""


class Cameras:
    """Every page has its own camera; all of them follow the same point."""

    def __init__(self, server: viser.ViserServer, box: Box) -> None:
        """Points the cameras of pages to come at a vehicle; their pictures' sizes are in CSS pixels."""
        self._server, self._box = server, box
        self._views: dict[int, tuple[str, Floats]] = {}
        self._lock = threading.RLock()  # pages tell of their cameras in several threads
        self._shift = np.zeros(3)
        self._n_glides = 0
        initial = server.initial_camera
        initial.position, initial.look_at = camera(box, ISO, 1000, 1000)
        initial.fov = FIELD_OF_VIEW
        scripts.run(server.scene, "css_pixels.js")

        @server.on_client_connect
        def _(client: viser.ClientHandle) -> None:
            self.look(client, ISO)
            client.camera.on_update(lambda _: self._keep_framed(client))

        @server.on_client_disconnect
        def _(client: viser.ClientHandle) -> None:
            self._views.pop(client.client_id, None)

    def look(self, client: viser.ClientHandle, view: str) -> None:
        """Turns a page's camera to one of `stage.VIEWS`; what is followed is in its middle."""
        with self._lock:
            pose = self._framed(client, view)
            self._views[client.client_id] = view, pose[0]
            _put(client, pose)

    def follow(self, point: Floats | None) -> None:
        """Glides all cameras, as far away and as turned as they are, to look at a point.

        Args:
            point: (3,), m; None goes back to the whole vehicle.
        """
        self._n_glides += 1
        self._shift = np.zeros(3) if point is None else point - self._box.middle
        for client in self._server.get_clients().values():
            threading.Thread(
                target=self._glide, args=(client, self._n_glides), name="glide", daemon=True
            ).start()

    def _glide(self, client: viser.ClientHandle, number: int) -> None:
        """Moves one camera until it is there or another glide begins."""
        begin = client.camera.position, client.camera.look_at
        end = self._target(client)
        for fraction in np.linspace(0, 1, GLIDE_STEPS + 1)[1:]:
            if number != self._n_glides:
                return
            eased = fraction**2 * (3 - 2 * fraction)
            _put(client, tuple(a + eased * (b - a) for a, b in zip(begin, end, strict=True)))
            time.sleep(STEP_SECONDS)

    def _target(self, client: viser.ClientHandle) -> Pose:
        """Where a glide ends: framed as before, or looking at the point if somebody moved it."""
        position, look_at = client.camera.position, client.camera.look_at
        view, put = self._views.get(client.client_id, (ISO, position))
        if _is_at(position, put):
            framed = self._framed(client, view)
            self._views[client.client_id] = view, framed[0]
            return framed
        target = self._box.middle + self._shift
        return position + target - look_at, target

    def _framed(self, client: viser.ClientHandle, view: str) -> Pose:
        size = client.camera.image_width, client.camera.image_height
        position, look_at = camera(self._box, view, *size)
        if not self._shift.any():
            return position, look_at
        return position - look_at + self._box.middle + self._shift, self._box.middle + self._shift

    def _keep_framed(self, client: viser.ClientHandle) -> None:
        """Looks again when the picture's shape has changed, unless somebody has moved the camera.

        viser puts the camera back where pages begin, even after it was framed if a page loads slowly.
        """
        with self._lock:
            if client.client_id not in self._views:
                return
            view, put = self._views[client.client_id]
            position, begin = client.camera.position, self._server.initial_camera.position
            is_untouched = _is_at(position, put) or _is_at(position, begin)
            if is_untouched and not _is_at(position, self._framed(client, view)[0]):
                self.look(client, view)


def _is_at(position: Floats, place: Floats) -> bool:
    return np.allclose(position, place, atol=UNTOUCHED)


def _put(client: viser.ClientHandle, pose: Pose) -> None:
    with client.atomic():
        client.camera.position, client.camera.look_at = pose
