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
    folded = {n.lower(): n for n in names}
    close = get_close_matches(name.lower(), folded, n=1)
    hint = f"did you mean {folded[close[0]]!r}? " if close else ""
    return f"unknown {kind} {name!r}: {hint}there are {', '.join(names) or 'none'}"


def check_unique(kind: str, names: Iterable[str]) -> None:
    """Checks that things which are found by their names can be.

    Raises:
        VehicleError: a name is empty or there twice.
    """
    seen = set()
    for name in names:
        if not name:
            raise VehicleError(f"{kind}: found an empty name")
        if name in seen:
            raise VehicleError(f"{kind} {name!r} is there twice; each needs its own name")
        seen.add(name)


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
