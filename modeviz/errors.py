"""The errors a user can cause, and how they read."""

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from difflib import get_close_matches
from itertools import accumulate
from pathlib import PurePath

MOST_NAMES = 30
"""So many of the names that exist are listed; the rest is counted."""

MOST_COMPARED = 5000
"""Among more names none is looked for that may be meant: that would take seconds."""

MOST_FAULTS = 5
"""Of what is wrong in one place with many tables, so much is said at once."""

LONGEST_NAME, LONGEST_REASON, LONGEST_LIST, LONGEST = 80, 200, 800, 2000
"""Letters of what is quoted, of a library's words, of listed names and of a whole text: what is longer
is cut."""


class ModevizError(Exception):
    """Something the user can put right; its text says what, where and how, at no great length."""

    def __init__(self, text: object = "") -> None:
        super().__init__(cut(str(text), LONGEST))


class VehicleError(ModevizError):
    """A vehicle that cannot be built or read."""


@dataclass(frozen=True)
class Fault:
    """What is wrong at one key of a file."""

    path: str
    """Of the key, "problem[0].group[1]"; empty for the whole."""
    words: str

    def __str__(self) -> str:
        return f"{self.path}: {self.words}" if self.path else self.words

    def within(self, key: str) -> "Fault":
        """Return the same with its path one step further out."""
        return replace(self, path=f"{key}.{self.path}" if self.path else key)


class FaultsError(VehicleError):
    """What is wrong at keys of a file: the text says the first `MOST_FAULTS`, `faults` has all."""

    def __init__(self, *faults: Fault) -> None:
        n_more = len(faults) - MOST_FAULTS
        more = [f"{n_more} more"] if n_more > 0 else []
        super().__init__("; ".join([*map(str, faults[:MOST_FAULTS]), *more]))
        self.faults: tuple[Fault, ...] = faults


class PartError(VehicleError):
    """What is wrong with a part of a vehicle, which is found by its kind and name."""

    def __init__(self, kind: str, name: str, words: str) -> None:
        super().__init__(f"{kind} {quoted(name)}{words}")
        self.kind: str = kind
        self.name: str = name


class SolveError(ModevizError):
    """A model that has no meaningful solution."""


def cut(text: str, longest: int) -> str:
    """The text, or its beginning and its end around "…" if it is longer than so many letters."""
    if len(text) <= longest:
        return text
    end = longest // 3
    return f"{text[: longest - end - 1]}…{text[-end:]}"


def quoted(value: object) -> str:
    """A name or a value as it is quoted in a sentence, not all of it if it is long."""
    if isinstance(value, str):
        return repr(cut(value, LONGEST_NAME))
    return cut(repr(value), LONGEST_NAME)


def kind_of(value: object) -> str:
    """Return what a value is, in words: "mesh part" of a `MeshPart`."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", type(value).__name__).lower()


def listed(names: Iterable[object]) -> str:
    """Names in a sentence, the first of many, with the number of the others."""
    every = [cut(str(name), LONGEST_NAME) for name in names]
    fitting = bisect_right([*accumulate(map(len, every))], LONGEST_LIST)
    n_said = min(MOST_NAMES, max(1, fitting))
    more = [f"{len(every) - n_said} more"] if len(every) > n_said else []
    return ", ".join([*every[:n_said], *more]) or "none"


def paths_together(paths: Iterable[PurePath]) -> str:
    """Paths in front of a sentence on all of them, a folder once: "parts/M.mtx, K.mtx"."""
    every = list(paths)
    folders = [None, *(path.parent for path in every)]
    return ", ".join(
        path.name if path.parent == before else str(path)
        for path, before in zip(every, folders, strict=False)
    )


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """A sentence saying that `name` is not one of `known`, with the likeliest meant first."""
    names = list(known)
    folded = {n.lower(): n for n in names}
    comparable = len(name) <= LONGEST_NAME and len(names) <= MOST_COMPARED
    close = get_close_matches(name.lower(), folded, n=1) if comparable else []
    hint = f"did you mean {quoted(folded[close[0]])}? " if close else ""
    return f"unknown {kind} {quoted(name)}: {hint}there are {listed(names)}"


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
            raise PartError(kind, name, " is there twice; each needs its own name")
        seen.add(name)


def reason(error: BaseException) -> str:
    """The first line of the words of an error of the system or a library, not all if it is long."""
    said = getattr(error, "strerror", None) or str(error).strip()
    return cut(next(iter(said.splitlines()), type(error).__name__), LONGEST_REASON)


def placed(where: str, text: str) -> str:
    """Return a text with the place that it speaks of in front, which is not said twice.

    A file may be called by its name alone in one of both: it is as the longer has it. Of several files,
    with commas between, the one that the text says is enough.
    """
    said, _, words = text.partition(": ")
    for place in (*where.split(", "), where):
        if words and _is_same_place(said, place):
            return f"{max(said, place, key=len)}: {words}"
    return f"{where}: {text}"


def _is_same_place(one: str, other: str) -> bool:
    """Whether two places are the same, or one is the name of the other, which is a path."""
    shorter, longer = sorted((one, other), key=len)
    return longer == shorter or longer.endswith((f"/{shorter}", f"\\{shorter}"))


@contextmanager
def of_file(path: str) -> Iterator[None]:
    """Puts a file, if there is one, in front of what its content makes impossible inside the block.

    Raises:
        ModevizError: something inside raised one; it stays of its kind.
    """
    try:
        yield
    except ModevizError as error:
        raise type(error)(placed(path, str(error)) if path else str(error)) from None


@contextmanager
def located(where: object) -> Iterator[None]:
    """Puts the place in front of whatever the user got wrong inside the block, if it isn't there.

    Raises:
        VehicleError: something inside raised a ModevizError.
    """
    try:
        yield
    except ModevizError as error:
        raise VehicleError(placed(str(where), str(error))) from None


@contextmanager
def at_key(key: str) -> Iterator[None]:
    """Says of whatever the user got wrong inside the block at which key of a file it is.

    Raises:
        FaultsError: something inside raised a ModevizError.
    """
    try:
        yield
    except FaultsError as error:
        raise FaultsError(*(fault.within(key) for fault in error.faults)) from None
    except ModevizError as error:
        raise FaultsError(Fault(key, str(error))) from None


@contextmanager
def of_part(kind: str, name: str) -> Iterator[None]:
    """Puts a part of a vehicle in front of whatever the user got wrong inside the block.

    Raises:
        PartError: something inside raised a ModevizError.
    """
    part = f"{kind} {quoted(name)}"
    try:
        yield
    except ModevizError as error:
        raise PartError(kind, name, placed(part, str(error)).removeprefix(part)) from None
