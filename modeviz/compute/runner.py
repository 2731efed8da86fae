"""Runners of many tasks of the same kind: in this process, or on other machines (`compute.cluster`)."""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, wait
from typing import Protocol, TypeVar

from modeviz.compute.cancel import CancelToken
from modeviz.compute.threads import N_THREADS, thread_pool

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
        """The results of a function for each item, in their order.

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
        waiting: deque[Future[T]] = deque()
        with thread_pool() as pool:
            for item in items:
                token.check()
                waiting.append(pool.submit(function, shared, item))
                if len(waiting) > N_THREADS:
                    yield _result(waiting.popleft(), token)
            while waiting:
                yield _result(waiting.popleft(), token)


def _result(future: Future[T], token: CancelToken) -> T:
    """Waits for a task as long as it may."""
    token.check()
    while not future.done():
        wait([future], POLL_S)
        token.check()
    return future.result()


HERE = Here()
