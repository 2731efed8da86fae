"""What somebody who means no good does to a server of many sessions; each ends by itself."""

import asyncio
import secrets
import time
from contextlib import suppress

from websockets.asyncio.client import connect

from benchmarks.attacks import BROKEN, N_SILENT, WATCH_S, Attack, allow_files, open_attack_page
from benchmarks.malformed import malformed
from benchmarks.page_client import handshake, own_origin

N_MALFORMED = 2000
MOST_OF_A_PAGE = 95
"""After a hundred messages that no page sends a page is closed."""

LARGE = 1_000_000
"""Bytes of a head that does not end."""


def malformed_messages(port: int) -> str:
    """Thousands of messages that no page sends, by as many pages as it takes."""

    async def attack() -> str:
        left, n_pages = list(malformed(N_MALFORMED, 0)), 0
        while left:
            with suppress(*BROKEN):
                async with open_attack_page(port) as page:
                    n_pages += 1
                    for _ in range(min(MOST_OF_A_PAGE, len(left))):
                        await page.send(left.pop())
                    await page.ping()
                    await asyncio.sleep(0.2)
        return f"{N_MALFORMED} said by {n_pages} pages"

    return asyncio.run(attack())


def guessed_sessions(port: int) -> str:
    """Keys of sessions, by which new ones are opened, as fast as websockets are answered."""
    return asyncio.run(_guess(port, "session", 16))


def guessed_reviews(port: int) -> str:
    """Keys of reviews."""
    return asyncio.run(_guess(port, "review", 16))


def guessed_pages(port: int) -> str:
    """Pages of sessions that do not exist."""

    async def attack() -> str:
        end, n_answered = time.monotonic() + WATCH_S, 0

        async def ask() -> None:
            nonlocal n_answered
            while time.monotonic() < end:
                with suppress(*BROKEN, asyncio.IncompleteReadError):
                    reader, writer = await asyncio.open_connection("127.0.0.1", port)
                    path = f"/?session={secrets.token_urlsafe(16)}"
                    writer.write(f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
                    await reader.read(100)
                    n_answered += 1
                    writer.close()

        await asyncio.gather(*(ask() for _ in range(20)))
        return f"{n_answered / WATCH_S:.0f} a second answered"

    return asyncio.run(attack())


def slow_heads(port: int) -> str:
    """Hundreds of requests that come byte by byte and never end."""
    allow_files(N_SILENT + 200)
    head = f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n".encode() + b"X: x\r\n" * 100

    async def send() -> bool:
        with suppress(*BROKEN):
            _, writer = await asyncio.open_connection("127.0.0.1", port)
            for byte in head:
                writer.write(bytes([byte]))
                await writer.drain()
                await asyncio.sleep(0.2)
            return True
        return False

    async def attack() -> str:
        tasks = [asyncio.create_task(send()) for _ in range(N_SILENT)]
        _, going = await asyncio.wait(tasks, timeout=1.5 * WATCH_S)
        for task in going:
            task.cancel()
        return f"{len(going)} of {N_SILENT} still read after {1.5 * WATCH_S:.0f} s"

    return asyncio.run(attack())


def huge_heads(port: int) -> str:
    """Heads of a megabyte that do not end, of one line and of many, again and again."""
    line = b"GET /" + b"x" * LARGE
    lines = b"GET / HTTP/1.1\r\n" + b"X: x\r\n" * (LARGE // 6)

    async def attack() -> str:
        end, n_sent = time.monotonic() + WATCH_S, 0

        async def send(head: bytes) -> None:
            nonlocal n_sent
            while time.monotonic() < end:
                with suppress(*BROKEN):
                    reader, writer = await asyncio.open_connection("127.0.0.1", port)
                    writer.write(head)
                    async with asyncio.timeout(WATCH_S):
                        await reader.read()
                    writer.close()
                n_sent += 1

        await asyncio.gather(*(send(head) for head in (line, lines) * 10))
        return f"{n_sent} sent"

    return asyncio.run(attack())


FRONT_ATTACKS = (
    Attack(f"{N_MALFORMED} malformed messages", malformed_messages),
    Attack("keys of sessions, by websocket", guessed_sessions),
    Attack("keys of reviews, by websocket", guessed_reviews),
    Attack("keys of sessions, by page", guessed_pages),
    Attack(f"{N_SILENT} slow heads", slow_heads),
    Attack("huge heads", huge_heads),
)


async def _guess(port: int, name: str, n_bytes: int) -> str:
    """Opens websockets with random keys, twenty at a time."""
    end = time.monotonic() + WATCH_S
    opened = refused = 0

    async def guess() -> None:
        nonlocal opened, refused
        while time.monotonic() < end:
            url = f"ws://127.0.0.1:{port}/?{name}={secrets.token_urlsafe(n_bytes)}"
            try:
                async with connect(url, open_timeout=WATCH_S, **handshake(own_origin(port))):
                    opened += 1
            except BROKEN:
                refused += 1

    await asyncio.gather(*(guess() for _ in range(20)))
    return f"{opened} opened, {refused} refused in {time.monotonic() - end + WATCH_S:.0f} s"
