"""Where many tasks of the same kind are computed: here, or on other machines (`compute.cluster`)."""

import os
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import Protocol, TypeVar

from threadpoolctl import threadpool_limits

from modeviz.compute.cancel import CancelToken

N_THREADS = min(4, os.cpu_count() or 1)
"""Tasks side by side: linear algebra does not hold the interpreter's lock."""

POLL_S = 0.05
"""Between looks at whether somebody ends it."""

S = TypeVar("S")
A = TypeVar("A")
T = TypeVar("T")


class Runner(Protocol):
    """Something that computes tasks."""

    def map(
        self, function: Callable[[S, A], T], shared: S, items: Sequence[A], token: CancelToken
    ) -> Iterator[T]:
        """What a function of a module or class gives for each item, in their order.

        Args:
            function: of what is shared and an item; the same numbers whoever calls it.
            shared: sent once.
            items: small.
            token: lets somebody hold or end it.

        Raises:
            CancelledError: it was told to end.
        """
        ...


class Here:
    """Computes in threads of this process, a few tasks ahead of who takes the results."""

    def map(
        self, function: Callable[[S, A], T], shared: S, items: Sequence[A], token: CancelToken
    ) -> Iterator[T]:
        pool, waiting = ThreadPoolExecutor(N_THREADS), deque()
        with threadpool_limits(1, user_api="blas"):
            try:
                for item in items:
                    token.check()
                    waiting.append(pool.submit(function, shared, item))
                    if len(waiting) > N_THREADS:
                        yield _result(waiting.popleft(), token)
                while waiting:
                    yield _result(waiting.popleft(), token)
            finally:
                # Tasks in hand are left to themselves: who ends it does not wait for them.
                pool.shutdown(wait=False, cancel_futures=True)


def _result(future: Future[T], token: CancelToken) -> T:
    """Waits for a task as long as it may."""
    token.check()
    while not future.done():
        wait([future], POLL_S)
        token.check()
    return future.result()


HERE = Here()
