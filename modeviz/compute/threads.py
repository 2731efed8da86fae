"""BLAS on one thread for what solves many small systems."""

from collections.abc import Callable
from contextvars import ContextVar
from functools import wraps
from typing import ParamSpec, TypeVar

from threadpoolctl import threadpool_limits

P = ParamSpec("P")
T = TypeVar("T")

_is_limited: ContextVar[bool] = ContextVar("is_limited", default=False)


def one_thread(function: Callable[P, T]) -> Callable[P, T]:
    """The same function with BLAS on one thread.

    A second one helps no system this small, beside other programs it is up to a hundred times slower,
    and it rounds otherwise: so the same seed finds the same to the last digit, however many threads a
    processor of one kind has. Another kind rounds otherwise too. Within another such function it costs
    nothing; by itself some ms, for the libraries are looked for.
    """

    @wraps(function)
    def on_one_thread(*arguments: P.args, **keywords: P.kwargs) -> T:
        if _is_limited.get():
            return function(*arguments, **keywords)
        token = _is_limited.set(True)
        try:
            with threadpool_limits(limits=1, user_api="blas"):
                return function(*arguments, **keywords)
        finally:
            _is_limited.reset(token)

    return on_one_thread
