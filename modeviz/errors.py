"""The errors a user can cause, and how they read."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from difflib import get_close_matches


class ModevizError(Exception):
    """Something the user can put right; its text says what, where and how."""


class VehicleError(ModevizError):
    """A vehicle that cannot be built or read."""


class SolveError(ModevizError):
    """A model that has no meaningful solution."""


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """A sentence saying that `name` is not one of `known`, with the likeliest meant first."""
    names = list(known)
    close = get_close_matches(name, names, n=1)
    hint = f"did you mean {close[0]!r}? " if close else ""
    return f"unknown {kind} {name!r}: {hint}there are {', '.join(names) or 'none'}"


@contextmanager
def located(where: object) -> Iterator[None]:
    """Puts the place in front of whatever the user got wrong inside the block.

    Raises:
        VehicleError: something inside raised a ModevizError.
    """
    try:
        yield
    except ModevizError as error:
        raise VehicleError(f"{where}: {error}") from None
