"""The whole page opened in a test, without what is slow to render in software."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress

from mounted_cabin import mounted_cabin
from visitors import CAMERA, encoded
from websockets.sync.connection import Connection

from benchmarks.websocket import open_websocket
from modeviz.analysis.results import Conditions
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.app import App
from modeviz.viewer.page.server import Server

SOLVE_S = 60


@contextmanager
def open_app(server: Server, vehicle: Vehicle, conditions: Conditions) -> Iterator[App]:
    """A vehicle's page that stands still and casts no shadows; nothing is solved yet."""
    app = App(vehicle, vehicle.rates, conditions, server)
    server.scene.configure_environment_map(None)
    app.scene._stage._key.cast_shadow = False
    app.screen.motion.animation._run(False)
    try:
        yield app
    finally:
        app.end()


@contextmanager
def open_solved_cabin(server: Server, cabin: Vehicle | None = None) -> Iterator[App]:
    """The page of the small cabin, or of one much like it, with its first answer."""
    with open_app(server, cabin or mounted_cabin(), Conditions("flat", 20.0)) as app:
        app.start()
        assert app.session.wait(SOLVE_S)
        yield app


@contextmanager
def listening(server: Server) -> Iterator[Connection]:
    """A websocket of a page that is open already, and has been told all there is."""
    with open_websocket(server.get_port(), "") as socket:
        socket.send(encoded(CAMERA))  # who says nothing for half a minute is closed
        n_bytes(socket)
        yield socket


def n_bytes(socket: Connection) -> int:
    """How much has come through a websocket until it is quiet for a second."""
    received = 0
    with suppress(TimeoutError):
        while True:
            received += len(socket.recv(timeout=1.0))
    return received
