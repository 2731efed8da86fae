"""What somebody who means no good does to the page of a vehicle; each ends by itself.

An attack runs in a process of its own, so that what it costs itself is not taken for the server's.
"""

import asyncio
import http.client
import resource
import socket
import time
from collections.abc import AsyncIterator, Callable
from contextlib import AsyncExitStack, asynccontextmanager, suppress
from dataclasses import dataclass
from functools import cache
from typing import Any

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import WebSocketException

from benchmarks.page_client import CAMERA, Message, handshake, messages, own_origin, session_query, wire

NESTED_BYTES = 20_000_000
QUATERNION_BYTES = 5_000_000
N_SILENT, N_ASKING, N_UPDATES = 500, 34, 30
WATCH_S = 10.0
"""How long an attack that waits goes on."""

BROKEN = (OSError, TimeoutError, WebSocketException, AttributeError)
"""How a server gets rid of who goes too far; the last is what websockets raises then at its end."""


@dataclass(frozen=True)
class Attack:
    """One of them."""

    name: str
    run: Callable[[int], str]
    """Does it to a port, and gives what came of it."""
    token: str | None = None
    """That the server asks for."""


def nested_maps(port: int) -> str:
    """Messages of nothing but empty maps: millions beside each other, and in each other."""
    beside = b"\x81\xa4type\xdd" + NESTED_BYTES.to_bytes(4, "big") + b"\x80" * NESTED_BYTES
    inside = b"\x81\xa1a" * (NESTED_BYTES // 3) + b"\x80"
    return asyncio.run(_say(port, [beside, beside, inside]))


def impossible_cameras(port: int) -> str:
    """Cameras without a height, and with a quaternion of millions of numbers."""
    n_numbers = QUATERNION_BYTES // 9
    long = wire("ViewerCameraMessage", **{**CAMERA, "wxyz": [0.5] * n_numbers})
    flat = wire("ViewerCameraMessage", **{**CAMERA, "image_height": 0})
    return asyncio.run(_say(port, [flat] * N_UPDATES + [long] * 5))


def impossible_values(port: int) -> str:
    """Values of a known slider that are none, in every way there is."""
    wrong = [10**18, 1e308, None, "x" * 1000, [], {}, [[1.0]], b"x"]

    async def attack() -> str:
        async with open_attack_page(port) as page:
            (slider,) = await _first(page, 1, _is_slider)
            updates = [{"value": value} for value in wrong]
            said = [{"uuid": slider["uuid"], "updates": each} for each in [*updates, 5, None, "x"]]
            said += [{"uuid": each, "updates": {"value": 1.0}} for each in ([], {}, None)]
            return await _send(page, [wire("GuiUpdateMessage", **each) for each in said] * 3)

    return asyncio.run(attack())


def pages_that_do_not_draw(port: int) -> str:
    """Many pages that ask for a picture of themselves and then do nothing."""

    async def attack() -> str:
        async with AsyncExitStack() as open_pages:
            entered = 0
            for _ in range(N_ASKING):
                with suppress(*BROKEN):
                    page = await open_pages.enter_async_context(open_attack_page(port))
                    (button,) = await _first(page, 1, lambda widget: _label(widget) == "Save…")
                    await page.send(
                        wire("GuiUpdateMessage", uuid=button["uuid"], updates={"value": True})
                    )
                    entered += 1
            await asyncio.sleep(WATCH_S)
        return f"{entered} asked"

    return asyncio.run(attack())


def silent_sockets(port: int) -> str:
    """Hundreds of websockets that say nothing."""
    allow_files(N_SILENT + 200)

    async def attack() -> str:
        opened: list[ClientConnection] = []

        async def enter() -> None:
            with suppress(*BROKEN):
                opened.append(await _socket(port))

        for _ in range(N_SILENT // 20):
            await asyncio.gather(*(enter() for _ in range(20)))
        await asyncio.sleep(WATCH_S)
        return f"{len(opened)} of {N_SILENT} let in"

    return asyncio.run(attack())


def half_handshakes(port: int) -> str:
    """Hundreds of connections that never end their request."""
    allow_files(N_SILENT + 200)
    opened = []
    for _ in range(N_SILENT):
        with suppress(OSError):
            opened.append(socket.create_connection(("127.0.0.1", port), timeout=2.0))
            opened[-1].sendall(b"GET / HTTP/1.1\r\n")
    time.sleep(1.3 * WATCH_S)
    left = sum(map(_is_open, opened))
    for each in opened:
        each.close()
    return f"{left} of {N_SILENT} open after {1.3 * WATCH_S:.0f} s"


def guessed_tokens(port: int) -> str:
    """Tokens as fast as they are answered, and one that is no ASCII."""
    strange = _status(port, "/", {"Cookie": f"modeviz{port}=\xff\xe9"})
    end, n_guesses = time.monotonic() + WATCH_S / 2, 0
    while time.monotonic() < end:
        with suppress(TimeoutError):
            _status(port, f"/?token=guess{n_guesses}", timeout=max(0.05, end - time.monotonic()))
            n_guesses += 1
    return f"{n_guesses} guesses in {WATCH_S / 2:.0f} s, not ASCII: status {strange}"


def flood(port: int) -> str:
    """Moves of a slider, which the quiet page leaves alone, as fast as they can be sent."""

    async def attack() -> str:
        async with open_attack_page(port) as page:
            _, slider = await _first(page, 2, _is_slider)
            low, high = (slider["props"][end] for end in ("min", "max"))
            end, sent = time.monotonic() + WATCH_S, 0
            with suppress(*BROKEN):
                while time.monotonic() < end:
                    value = low + (high - low) * (sent % 97) / 96
                    said = wire("GuiUpdateMessage", uuid=slider["uuid"], updates={"value": value})
                    async with asyncio.timeout(max(0.1, end - time.monotonic())):
                        await page.send(said)
                    sent += 1
            return f"{sent / WATCH_S:.0f} a second taken"

    return asyncio.run(attack())


def large_page(port: int) -> str:
    """A page that claims to be huge, asks for a picture of itself whole, and leaves."""

    async def attack() -> str:
        async with open_attack_page(port) as page:
            kind, button = await _first(page, 2, lambda widget: _label(widget) in ("Save", "Save…"))
            size = {"image_width": 30_000, "image_height": 20_000}
            whole = {"uuid": kind["uuid"], "updates": {"value": "Whole page, PNG"}}
            press = {"uuid": button["uuid"], "updates": {"value": True}}
            await page.send(wire("ViewerCameraMessage", **{**CAMERA, **size}))
            await page.send(wire("GuiUpdateMessage", **whole))
            await asyncio.sleep(1.0)
            await page.send(wire("GuiUpdateMessage", **press))
            await asyncio.sleep(3 * WATCH_S)
        await asyncio.sleep(WATCH_S)
        return "left after 30 s"

    return asyncio.run(attack())


ATTACKS = (
    Attack("20 MB of nested maps, 3 times", nested_maps),
    Attack("impossible cameras", impossible_cameras),
    Attack("impossible values of a slider", impossible_values),
    Attack(f"{N_ASKING} pages ask for pictures, draw none", pages_that_do_not_draw),
    Attack(f"{N_SILENT} silent websockets", silent_sockets),
    Attack(f"{N_SILENT} half handshakes", half_handshakes),
    Attack("tokens guessed", guessed_tokens, token="a-long.secret_1"),
    Attack("flood of moves", flood),
)
WITH_CHROMIUM = Attack("a page of 30 000 x 20 000", large_page)


async def _say(port: int, said: list[bytes]) -> str:
    """Says everything as one page, and looks whether it is still open."""
    try:
        async with open_attack_page(port) as page:
            return await _send(page, said)
    except BROKEN:
        return "closed"


async def _send(page: ClientConnection, said: list[bytes]) -> str:
    try:
        for each in said:
            await page.send(each)
        await asyncio.sleep(WATCH_S / 5)
        await page.ping()
    except BROKEN:
        return "closed"
    return "still open" if page.close_code is None else "closed"


async def _first(
    page: ClientConnection, n_messages: int, is_wanted: Callable[[Message], bool]
) -> list[Message]:
    """The first so many messages of a kind that a page is sent."""
    found: list[Message] = []
    async with asyncio.timeout(60.0):
        while len(found) < n_messages:
            found += filter(is_wanted, messages(await page.recv()))
    return found[:n_messages]


def _label(message: Message) -> str | None:
    return message.get("props", {}).get("label")


def _is_slider(message: Message) -> bool:
    return message["type"] == "GuiSliderMessage"


@asynccontextmanager
async def open_attack_page(port: int) -> AsyncIterator[ClientConnection]:
    """A page as viser knows one: it has told its camera."""
    async with _socket(port) as page:
        await page.send(wire("ViewerCameraMessage", **CAMERA))
        yield page


@cache
def _own_session(port: int) -> str:
    """That of the attacker, in which all their pages are."""
    return session_query(port)


def _socket(port: int) -> connect:
    url, limits = (
        f"ws://127.0.0.1:{port}/{_own_session(port)}",
        {"open_timeout": WATCH_S, "close_timeout": 0.5},
    )
    return connect(url, **limits, **handshake(own_origin(port)))


def _status(port: int, path: str, headers: dict[str, Any] | None = None, timeout: float = 5.0) -> int:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=timeout)
    try:
        connection.request("GET", path, headers=headers or {})
        return connection.getresponse().status
    except (http.client.HTTPException, ConnectionError):
        return 0
    finally:
        connection.close()


def _is_open(connection: socket.socket) -> bool:
    """Whether the other end has not closed."""
    connection.setblocking(False)
    try:
        return connection.recv(1) != b""
    except BlockingIOError:
        return True
    except OSError:
        return False


def allow_files(n_files: int) -> None:
    """Lets this process have so many files open, as far as it may."""
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(n_files, most), most))
