"""Files that a page sent, on this machine's disk until the page of bodies ends."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePath
from tempfile import TemporaryDirectory

from modeviz.errors import ModevizError, VehicleError
from modeviz.formats.endings import TAKEN
from modeviz.formats.matrices import SUFFIXES as MATRICES
from modeviz.formats.mounts.imported import SUFFIXES as MOUNTS
from modeviz.formats.reading import READERS
from modeviz.formats.roads.imported import SUFFIXES as ROADS

MOST_BYTES = 400_000_000
"""Of all of them."""

MOST_FILES = 100
LONGEST_NAME = 100
"""Bytes."""


class Received:
    """The files of one component, as far as they have come."""

    def __init__(self) -> None:
        """Starts with none."""
        self._folder = TemporaryDirectory(prefix="modeviz-")
        self._paths: dict[str, Path] = {}

    @property
    def names(self) -> tuple[str, ...]:
        """What they are called, in the order in which they came."""
        return tuple(self._paths)

    def add(self, name: str, content: bytes) -> None:
        """Keeps a file, which others may include; one of the same name goes.

        Mounts and roads that are still there go before a component's results.

        Raises:
            VehicleError: it has no name, or there are too many files or bytes.
        """
        name = _written(PurePath(name.replace("\\", "/")).name)
        if not name or name in (".", ".."):
            raise VehicleError("a file without a name has come")
        if name not in self._paths and len(self._paths) >= MOST_FILES:
            raise VehicleError(f"{name}: is one more than {MOST_FILES} files; use modeviz import")
        if _has_results(name) and all(map(_is_alone, self._paths)):
            self.clear()
        path = Path(self._folder.name, name)
        others = sum(p.stat().st_size for n, p in self._paths.items() if n != name)
        if others + len(content) > MOST_BYTES:
            raise VehicleError(
                f"{name}: with the others more than {MOST_BYTES / 1e6:.0f} MB; use modeviz import"
            )
        path.write_bytes(content)
        self._paths[name] = path

    def clear(self) -> None:
        """Forgets all of them."""
        for path in self._paths.values():
            path.unlink(missing_ok=True)
        self._paths.clear()

    @contextmanager
    def told(self) -> Iterator[list[Path]]:
        """The files to read, not those that they may include; errors do not say where they are.

        Raises:
            VehicleError: there is none, or something inside raised one.
        """
        paths = [path for path in self._paths.values() if path.suffix.lower() in TAKEN]
        if not paths:
            raise VehicleError(f"no file to read yet, expected one of {', '.join(TAKEN)}")
        try:
            yield paths
        except ModevizError as error:
            raise VehicleError(str(error).replace(f"{self._folder.name}/", "")) from None

    def close(self) -> None:
        """Deletes them."""
        self._folder.cleanup()


def _written(name: str) -> str:
    """A name as a file can have it: its end, of letters that are printed."""
    letters = "".join(filter(str.isprintable, name)).encode("utf-8", "ignore")
    written = letters[-LONGEST_NAME + 4 :].decode("utf-8", "ignore")
    return f"file{written}" if written.startswith(".") and written.strip(".") else written


def _has_results(name: str) -> bool:
    """Whether a file has a component's results, and not matrices, which go with a table of nodes."""
    suffix = PurePath(name).suffix.lower()
    return suffix in READERS and suffix not in MATRICES


def _is_alone(name: str) -> bool:
    """Whether a file has mounts or a road, or is a table of nodes."""
    return PurePath(name).suffix.lower() in (*MOUNTS, *ROADS)
