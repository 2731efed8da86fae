"""Servers of several sessions behind one front, opened at once."""

import threading
from contextlib import suppress

import websockets.asyncio.server
from visitors import wait_until

from modeviz.viewer.page.front import open_front
from modeviz.viewer.page.server import Server

N_SERVERS = 12


def test_servers_that_are_opened_at_once_have_each_a_loop_of_its_own():
    """Else pages of one session would be served by another."""
    serve = websockets.asyncio.server.serve
    front = open_front(port=0)
    servers = []
    opening = [
        threading.Thread(target=lambda: servers.append(Server(front)), daemon=True)
        for _ in range(N_SERVERS)
    ]
    for thread in opening:
        thread.start()
    try:
        wait_until(lambda: len(servers) == N_SERVERS)
        loops = {id(server.acceptor._loop) for server in servers}
        assert len(loops) == N_SERVERS
        for server in servers:
            assert server.acceptor._loop is server._websock_server._background_event_loop
        assert websockets.asyncio.server.serve is serve
    finally:
        for server in servers:
            with suppress(RuntimeError):
                server.stop()
        front.close()
