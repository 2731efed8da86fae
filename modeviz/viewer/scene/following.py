"""Cameras of pages that only look, kept where the camera of whoever presents is."""

import json
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import viser

from modeviz.vehicle.arrays import Floats
from modeviz.viewer.page.widgets import scripts

PAUSE = 0.05
"""s between two places that followers are sent; pages glide from one to the next."""

CLOSE = 1e-3
"""Of the distance looked over: a camera so near is where it was sent."""

FOLLOW = "follow"


@dataclass(frozen=True)
class _Switch:
    """What lets a page follow."""

    widget: str
    """Its name on the page, which switches it off when whoever looks turns the camera himself."""
    number: int
    """How often something was switched on: a page leaves out what it was sent before."""


class Following:
    """Sends followers the newest place of the leading camera, never more often than `PAUSE`.

    All is done in the server's loop, in which pages tell of their cameras.
    """

    def __init__(self, server: viser.ViserServer, has_control: Callable[[int], bool]) -> None:
        """Nobody follows yet.

        Args:
            server: with all pages.
            has_control: whether a page may lead.
        """
        self._server, self._has_control = server, has_control
        self._loop = server.get_event_loop()
        self._switches: dict[int, _Switch] = {}
        self._n_switched = 0
        self._is_planned, self._sent_at = False, 0.0
        scripts.run(server.scene, "scene/follow.js")

        @server.on_client_connect
        def _(client: viser.ClientHandle) -> None:
            @client.camera.on_update
            async def _(_: viser.CameraHandle) -> None:
                self._plan()

        @server.on_client_disconnect
        def _(client: viser.ClientHandle) -> None:
            self._switches.pop(client.client_id, None)

    def is_led(self, page: int) -> bool:
        """Whether a page's camera goes where another one goes."""
        return page in self._switches and not self._has_control(page) and self._leader() is not None

    def switch(self, page: int, widget: str | None) -> None:
        """Lets a page follow whenever it has no control, or no longer.

        Args:
            page: which.
            widget: the name of the checkbox with which it is switched off; None does so.
        """
        if widget is None:
            self._switches.pop(page, None)
        else:
            self._n_switched += 1
            self._switches[page] = _Switch(widget, self._n_switched)
        self.look_again()

    def look_again(self) -> None:
        """Has followers sent where they are to look, as somebody else may lead now."""
        self._loop.call_soon_threadsafe(self._plan)

    def _plan(self) -> None:
        if not self._is_planned:
            self._is_planned = True
            wait = self._sent_at + PAUSE - time.monotonic()
            self._loop.call_later(max(wait, 0.0), self._send)

    def _send(self) -> None:
        """Sends every follower that is elsewhere to where the leader looks from."""
        self._is_planned, self._sent_at = False, time.monotonic()
        leader = self._leader()
        if leader is None:
            return
        for client, switch in self._followers():
            position, look_at = leader.camera.position, leader.camera.look_at
            position = look_at + _farther(leader.camera, client.camera) * (position - look_at)
            if _is_at(client.camera, position, look_at):
                continue
            said = json.dumps([position.tolist(), look_at.tolist(), switch.widget, switch.number])
            scripts.say_newest(client, FOLLOW, f"window.__modevizFollow?.(...{said});")

    def _leader(self) -> viser.ClientHandle | None:
        """The page in control whose camera was moved last."""
        pages = self._server.get_clients().items()
        leading = [client for page, client in pages if self._has_control(page)]
        return max(leading, key=lambda client: client.camera.update_timestamp, default=None)

    def _followers(self) -> Iterator[tuple[viser.ClientHandle, _Switch]]:
        for page, client in self._server.get_clients().items():
            switch = self._switches.get(page)
            if switch is not None and not self._has_control(page):
                yield client, switch


def _farther(leading: viser.CameraHandle, following: viser.CameraHandle) -> float:
    """How many times as far a camera has to be to see, in a narrower picture, what another one sees."""
    return max(1.0, leading.aspect / following.aspect)


def _is_at(camera: viser.CameraHandle, position: Floats, look_at: Floats) -> bool:
    near = CLOSE * float(np.linalg.norm(position - look_at))
    return np.allclose(camera.position, position, rtol=0, atol=near) and np.allclose(
        camera.look_at, look_at, rtol=0, atol=near
    )
