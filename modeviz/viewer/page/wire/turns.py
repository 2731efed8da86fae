"""The threads in which viser calls us: pages take turns there, however much each has to do."""

import threading
from collections import Counter, OrderedDict, deque
from collections.abc import Callable, Hashable
from concurrent.futures import Future, ThreadPoolExecutor
from contextvars import ContextVar
from functools import partial
from typing import Any

N_THREADS = 32
MOST_OF_ONE = 4
"""Threads that a page has at once."""

MOST_WAITING = 20
"""Calls of a page that wait before no more of its messages are read."""

NOBODY = object()

page_heard: ContextVar[Hashable] = ContextVar("page_heard", default=None)
"""The page whose message is being handled, in the server's loop and in the thread of what it called."""


class Turns(ThreadPoolExecutor):
    """Runs the oldest call of the page whose turn it is; each has few threads at once.

    A call that fails is reported, and counts as done: viser would print all of it, every time.
    """

    def __init__(self, report: Callable[[Hashable, Exception], None]) -> None:
        """Starts with nothing to do.

        Args:
            report: told of the page and what a call for it raised.
        """
        super().__init__(N_THREADS, "page")
        self._report = report
        self._lock = threading.Lock()
        self._waiting: OrderedDict[Hashable, deque[Callable[[], None]]] = OrderedDict()
        self._running: Counter[Hashable] = Counter()

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Has something called when it is the turn of the page whose message is being handled."""
        future: Future[Any] = Future()
        page = page_heard.get()
        with self._lock:
            calls = self._waiting.setdefault(page, deque())
            calls.append(partial(self._call, page, future, partial(fn, *args, **kwargs)))
            self._start()
        return future

    def n_waiting(self, page: Hashable) -> int:
        """The number of calls of a page that have not begun."""
        with self._lock:
            return len(self._waiting.get(page, ()))

    def _start(self) -> None:
        """Starts what can be started; the lock is held."""
        while self._running.total() < N_THREADS and (page := self._next()) is not NOBODY:
            call = self._waiting[page].popleft()
            if not self._waiting[page]:
                del self._waiting[page]
            else:
                self._waiting.move_to_end(page)
            self._running[page] += 1
            super().submit(call)

    def _next(self) -> Hashable:
        """The page that has waited longest of those that may have a thread."""
        free = (page for page in self._waiting if self._running[page] < MOST_OF_ONE)
        return next(free, NOBODY)

    def _call(self, page: Hashable, future: Future[Any], call: Callable[[], Any]) -> None:
        page_heard.set(page)
        try:
            result = call()
        except Exception as error:
            self._report(page, error)
            result = None
        with self._lock:
            self._running[page] -= 1
            if not self._running[page]:
                del self._running[page]
            self._start()
        future.set_result(result)
