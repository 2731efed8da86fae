"""Files that a page sent, on this machine's disk until the page of bodies ends."""

from pathlib import Path, PurePath
from tempfile import TemporaryDirectory

from modeviz.errors import VehicleError
from modeviz.files.disk import confined_to
from modeviz.formats.component import Component
from modeviz.formats.reading import ENDINGS, is_read, read_component

MOST_BYTES = 400_000_000
"""Of all of them."""

MOST_FILES = 100
LONGEST_NAME = 100


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

        Raises:
            VehicleError: it has no name, or there are too many files or bytes.
        """
        name = PurePath(name.replace("\\", "/")).name[-LONGEST_NAME:]
        if not name or name in (".", ".."):
            raise VehicleError("a file without a name has come")
        if name not in self._paths and len(self._paths) >= MOST_FILES:
            raise VehicleError(f"{name}: is one more than {MOST_FILES} files; use modeviz import")
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

    def read(self) -> Component:
        """Return what they have, of no file but these.

        Raises:
            VehicleError: they cannot be read.
        """
        folder = Path(self._folder.name)
        if not any(map(is_read, self._paths.values())):
            raise VehicleError(f"no file to read yet, expected one of {', '.join(ENDINGS)}")
        try:
            with confined_to(folder):
                return read_component([p for p in self._paths.values() if is_read(p)])
        except VehicleError as error:
            raise VehicleError(str(error).replace(f"{folder}/", "")) from None

    def close(self) -> None:
        """Deletes them."""
        self._folder.cleanup()
