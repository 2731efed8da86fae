"""A slider dragged through a real websocket, as the page in a browser drags it."""

import io
import multiprocessing
import socket
import statistics
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path

import numpy as np
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect
from websockets.sync.connection import Connection as Page

from benchmarks.page_client import CAMERA, Message, handshake, messages, own_origin, session_query, wire
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.study.conditions import road_conditions
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.serve import serve

N_FIRST = 6
"""Moves that are not counted: the server rests before them, and gives up what it does then."""

REST_S = 1.5
PATIENCE_S = 60.0


@dataclass(frozen=True)
class Drag:
    """What a move of a slider takes."""

    websocket_ms: float
    """Median from the move to its new spectrum."""
    server_ms: float
    """Processor time of the whole server for a move."""


def drag(n_moves: int, folder: Path | None = None) -> Drag:
    """Drags the first slider of a vehicle's page over its range, in so many moves.

    Args:
        n_moves: that are counted.
        folder: of the vehicle; None: the built-in truck.
    """
    with served(folder or builtin_vehicle()) as (port, clock), open_page(port) as page:
        slider, spectrum = widgets(page)
        low, high = (slider["props"][end] for end in ("min", "max"))
        rates = np.linspace(high, low, N_FIRST + n_moves).round()
        move(page, slider, rates[0], spectrum)  # answered once the vehicle is prepared
        rest(page)
        for rate in rates[1:N_FIRST]:
            move(page, slider, rate, spectrum)
        begin = _processor_s(clock)
        times = [move(page, slider, rate, spectrum) for rate in rates[N_FIRST:]]
        used = _processor_s(clock) - begin
    return Drag(1e3 * statistics.median(times), 1e3 * used / n_moves)


def move(page: Page, slider: Message, rate: float, spectrum: Message) -> float:
    """Seconds from a move of the slider until its spectrum is here."""
    begin = time.perf_counter()
    say(page, slider, rate)
    next(message for message in _received(page) if _is_news(message, spectrum, "data"))
    return time.perf_counter() - begin


def say(page: Page, slider: Message, rate: float) -> None:
    """Says that the slider of a page has been moved."""
    page.send(wire("GuiUpdateMessage", uuid=slider["uuid"], updates={"value": float(rate)}))


def wait_for_answer(page: Page, slider: Message, rate: float, spectrum: Message) -> None:
    """Waits until a page is told of another's move of the slider and of a spectrum, in any order."""
    heard = drawn = False
    for message in _received(page):
        heard |= _is_news(message, slider, "value") and message["updates"]["value"] == rate
        drawn |= _is_news(message, spectrum, "data")
        if heard and drawn:
            return


def _is_news(message: Message, widget: Message, what: str) -> bool:
    return message.get("uuid") == widget["uuid"] and what in message.get("updates", ())


def widgets(page: Page) -> tuple[Message, Message]:
    """The first slider and, once it has been drawn, the first spectrum."""
    slider = spectrum = None
    for message in _received(page):
        if message["type"] == "GuiSliderMessage":
            slider = slider or message
        elif message["type"] == "GuiUplotMessage" and message["props"]["series"][0]["label"] == "Hz":
            spectrum = spectrum or message
        if slider and spectrum:
            break
    assert slider
    assert spectrum
    return slider, spectrum


def rest(page: Page) -> None:
    """Lets the server come to rest, as it is before somebody drags."""
    end = time.monotonic() + REST_S
    with suppress(TimeoutError):
        while (left := end - time.monotonic()) > 0:
            page.recv(timeout=left)


def _received(page: Page) -> Iterator[Message]:
    """What the server sends."""
    while True:
        yield from messages(page.recv(timeout=PATIENCE_S))


@contextmanager
def open_page(port: int, query: str | None = None) -> Iterator[Page]:
    """A page that has opened; viser knows it once it has told its camera.

    Args:
        port: of the server.
        query: that says the session; None: a new one.
    """
    with _connect(port, query) as page:
        page.send(wire("ViewerCameraMessage", **CAMERA))
        yield page


def open_websocket(port: int, query: str) -> Page:
    """Connects to a page's server as a browser here does, for messages of any size and number."""
    site, options = f"ws://127.0.0.1:{port}/{query}", handshake(own_origin(port))
    return connect(site, open_timeout=PATIENCE_S, max_queue=None, **options)


def _connect(port: int, query: str | None) -> Page:
    """Knocks until the server has started."""
    deadline = time.monotonic() + PATIENCE_S
    while True:
        try:
            return open_websocket(port, session_query(port) if query is None else query)
        except (ConnectionRefusedError, InvalidStatus):
            if time.monotonic() > deadline:
                raise
            time.sleep(0.1)


@contextmanager
def served(folder: Path) -> Iterator[tuple[int, Connection]]:
    """The port of a vehicle's page in a process of its own, and that process's clock."""
    port = free_port()
    context = multiprocessing.get_context("spawn")
    clock, far_end = context.Pipe()
    process = context.Process(target=_serve, args=(folder, port, far_end), daemon=True)
    process.start()
    try:
        yield port, clock
    finally:
        process.terminate()
        process.join()


def _serve(folder: Path, port: int, clock: Connection) -> None:
    """Serves the page, and tells the processor time used so far when asked."""
    threading.Thread(target=_tell_processor_s, args=(clock,), daemon=True).start()
    vehicle = read_vehicle(folder)
    conditions = road_conditions(vehicle, None, vehicle.speed)
    with redirect_stdout(io.StringIO()):
        bench = Bench(vehicle, vehicle.rates, conditions)
        serve({vehicle.name: bench}, "127.0.0.1", port, token=None, dark=False)


def _tell_processor_s(clock: Connection) -> None:
    while clock.recv():
        clock.send(time.process_time())


def _processor_s(clock: Connection) -> float:
    clock.send(True)
    return clock.recv()


def free_port() -> int:
    """One that nobody listens on."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]
