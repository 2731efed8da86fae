"""Tasks on a dask.distributed cluster: other machines, or more processes of this one."""

import socket
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent import futures
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar
from urllib.parse import urlsplit

from modeviz.compute.cancel import CancelToken
from modeviz.compute.runner import HERE, Runner
from modeviz.compute.threads import one_thread
from modeviz.errors import ModevizError, quoted

if TYPE_CHECKING:
    from distributed import Client, Future

TIMEOUT_S = 5.0
"""For a scheduler to answer, and to have a worker."""

PATIENCE_S = 30.0
"""For new workers to come, once all are lost."""

POLL_S = 0.1
"""Between looks at whether somebody ends it."""

AHEAD = 3
"""Tasks for each thread of the workers: so that none waits, and results do not pile up here."""

S = TypeVar("S")
A = TypeVar("A")
T = TypeVar("T")


@contextmanager
def runner_at(address: str | None) -> Iterator[Runner]:
    """A runner on the cluster of a scheduler, or in this process if there is no address.

    Scheduler and workers need the same version of modeviz. The numbers are the same wherever they come
    from, to the last digit on the same kind of processor.

    Args:
        address: such as "tcp://10.0.0.1:8786".

    Raises:
        ModevizError: nobody answers there, no worker is there, or dask is not installed.
    """
    if address is None:
        yield HERE
        return
    with _client(address) as client:
        yield _Cluster(client)


@contextmanager
def _client(address: str) -> "Iterator[Client]":
    try:
        from distributed import Client
    except ImportError:
        raise ModevizError(
            'a scheduler needs dask.distributed: pip install "modeviz[cluster]"'
        ) from None
    where = f"scheduler {quoted(address)}"
    try:
        # A client that finds nobody leaves its threads behind, so it is not the one to try.
        socket.create_connection(_host_and_port(address), TIMEOUT_S).close()
        client = Client(address, timeout=TIMEOUT_S, set_as_default=False)
    except (OSError, ValueError, OverflowError):
        raise ModevizError(
            f"{where}: nobody answers there; expected the address that dask scheduler prints, such as "
            "tcp://10.0.0.1:8786"
        ) from None
    try:
        client.wait_for_workers(1, TIMEOUT_S)
        yield client
    except TimeoutError:
        raise ModevizError(
            f"{where}: it has no workers; start one with dask worker {address}"
        ) from None
    finally:
        client.close()


def _host_and_port(address: str) -> tuple[str, int]:
    """Host and port of an address such as "tcp://10.0.0.1:8786"; raises ValueError for another one."""
    parts = urlsplit(address)
    if parts.scheme not in ("tcp", "tls") or not parts.hostname or not parts.port:
        raise ValueError(address)
    return parts.hostname, parts.port


class _Cluster:
    """Computes on the workers of a scheduler. What a lost worker had is computed by another one."""

    def __init__(self, client: "Client") -> None:
        self._client = client

    def map(
        self, function: Callable[[S, A], T], shared: S, items: Sequence[A], token: CancelToken
    ) -> Iterator[T]:
        kept = self._sent(shared)
        n_ahead = AHEAD * max(1, self._n_threads())
        waiting: deque[Future] = deque()
        try:
            for item in items:
                waiting.append(self._client.submit(_solved, function, kept, item, pure=False))
                if len(waiting) >= n_ahead:
                    yield self._result(waiting.popleft(), token)
            while waiting:
                yield self._result(waiting.popleft(), token)
        finally:
            self._client.cancel([*waiting, kept], force=True)

    def _sent(self, shared: object) -> "Future":
        """The shared value as a task: other than what is scattered, it outlives its workers."""
        import dask.config

        with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1GB"}):
            return self._client.submit(_kept, shared, pure=False)

    def _result(self, future: "Future", token: CancelToken):
        """Waits for a task while there is hope."""
        from distributed import KilledWorker

        last_seen = time.monotonic()
        while True:
            token.check()
            try:
                return future.result(POLL_S)
            except TimeoutError:
                last_seen = time.monotonic() if self._n_threads() else last_seen
            except KilledWorker as error:
                raise ModevizError(f"the workers end while they compute: {error}") from None
            except futures.CancelledError:
                raise ModevizError("the scheduler is lost; start it and this again") from None
            except ImportError as error:
                raise ModevizError(f"the workers need the same modeviz as here: {error}") from None
            if time.monotonic() - last_seen > PATIENCE_S:
                raise ModevizError("all workers of the scheduler are lost")

    def _n_threads(self) -> int:
        """The number of threads of all workers."""
        by_worker: Any = self._client.nthreads()
        return sum(by_worker.values())


def _kept(shared: S) -> S:
    return shared


def _solved(function: Callable[[S, A], T], shared: S, item: A) -> T:
    """A task, with as many BLAS threads as here."""
    with one_thread():
        return function(shared, item)
