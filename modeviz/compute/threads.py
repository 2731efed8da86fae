"""Threads: ours side by side, with one of BLAS each, and one of BLAS for whoever begins work."""

import os
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from typing import TypeVar

from threadpoolctl import threadpool_limits

Item = TypeVar("Item")
Result = TypeVar("Result")

N_THREADS = min(4, os.cpu_count() or 1)
"""Tasks side by side: linear algebra does not hold the interpreter's lock."""


class _Limit:
    """The limit of this process, which is there as long as somebody wants it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._n_holders = 0
        self._set = None

    def hold(self) -> None:
        with self._lock:
            if not self._n_holders:
                self._set = threadpool_limits(limits=1, user_api="blas")
            self._n_holders += 1

    def release(self) -> None:
        with self._lock:
            self._n_holders -= 1
            if self._set and not self._n_holders:
                self._set.restore_original_limits()


_limit = _Limit()


@contextmanager
def one_thread() -> Iterator[None]:
    """BLAS has one thread within, in the whole process; also to be put on a function.

    A second one helps no system this small, beside other programs it is up to a hundred times slower,
    and it rounds otherwise: so the same seed finds the same to the last digit, however many threads a
    processor of one kind has. Another kind rounds otherwise too. Only who begins work asks for it (a
    command, a study, a page, a task of a cluster), since it holds for everybody and takes some ms, for
    the libraries are looked for; whoever is last to leave gives the threads back.
    """
    _limit.hold()
    try:
        yield
    finally:
        _limit.release()


@contextmanager
def thread_pool() -> Iterator[ThreadPoolExecutor]:
    """A pool of `N_THREADS`, with one of BLAS each.

    Who leaves it early does not wait: tasks in hand are left to themselves, the others are cancelled.
    """
    pool = ThreadPoolExecutor(N_THREADS)
    with one_thread():
        try:
            yield pool
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def in_turn(
    pool: ThreadPoolExecutor, work: Callable[[Item], Result], items: Iterable[Item]
) -> Iterator[Result]:
    """Yields what work gives for each item in turn, with two tasks a thread ahead of who takes them."""
    ahead: deque[Future[Result]] = deque()
    for item in items:
        ahead.append(pool.submit(work, item))
        if len(ahead) > 2 * N_THREADS:
            yield ahead.popleft().result()
    while ahead:
        yield ahead.popleft().result()
