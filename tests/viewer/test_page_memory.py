"""What pages leave behind in memory that come to a session and go."""

import gc
import tracemalloc

from serving_cabin import page_at, serving, way
from visitors import wait_until

FIRST, N_PAGES = 4, 10
MOST_KB = 20.0
"""For each page, which is sent a hundred times as much, and has thousands of objects while it lasts."""


def come_and_go(front, path, session, n_pages):
    for _ in range(n_pages):
        with page_at(front, path):
            wait_until(session.server.get_clients)
        wait_until(lambda: not session.server.get_clients())


def test_pages_that_have_gone_leave_nothing_in_a_sessions_memory():
    with serving() as (front, directory):
        path = way(front)
        with page_at(front, path):
            wait_until(lambda: directory.sessions.open)
            (session,) = directory.sessions.open.values()
            wait_until(lambda: session.app.session.answer, 60)
            assert session.app.session.wait_checked(60)
        come_and_go(front, path, session, FIRST)
        gc.collect()
        tracemalloc.start()
        try:
            come_and_go(front, path, session, N_PAGES)
            wait_until(lambda: _traced_kb() < N_PAGES * MOST_KB, 5)
        finally:
            tracemalloc.stop()


def _traced_kb():
    gc.collect()
    return tracemalloc.get_traced_memory()[0] / 1024
