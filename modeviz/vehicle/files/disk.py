"""Files and folders, with errors a user can act on."""

import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from modeviz.errors import VehicleError, quoted


def read_bytes(path: Path) -> bytes:
    """The content of a file.

    Raises:
        VehicleError: it is not there or cannot be read.
    """
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise VehicleError(f"{path}: there is no such file") from None
    except (OSError, ValueError) as error:
        raise VehicleError(f"{path}: cannot be read ({error})") from None


def read_text(path: Path) -> str:
    """The content of a UTF-8 text file; raises VehicleError as `read_bytes` does."""
    try:
        return read_bytes(path).decode()
    except UnicodeDecodeError as error:
        raise VehicleError(f"{path}: found bytes that are not UTF-8 text ({error})") from None


def write_text(path: Path, text: str) -> None:
    """Writes a UTF-8 text file with plain line ends; all of it or nothing, errors as `write_bytes`."""
    write_bytes(path, text.encode())


def write_bytes(path: Path, content: bytes) -> None:
    """Writes a file, all of it or nothing.

    Raises:
        VehicleError: it cannot be written.
    """
    with _scratch_for(path) as scratch:
        new = scratch / "new"
        new.write_bytes(content)
        new.replace(path.resolve())


def check_writable(path: Path) -> None:
    """Checks that a file can be written, before the work for it begins.

    Raises:
        VehicleError: it cannot.
    """
    with _scratch_for(path):
        pass


@contextmanager
def _scratch_for(path: Path) -> Iterator[Path]:
    """A folder on the disk of a file that is to be written; raises VehicleError as `write_bytes`."""
    try:
        if path.exists() and not path.is_file():
            raise VehicleError(f"{path}: found a folder or device, expected a file or a new name")
        folder = path.resolve().parent
        if not folder.is_dir():
            raise VehicleError(f"{path}: cannot be written (there is no folder {folder})")
        with TemporaryDirectory(prefix=".modeviz-", dir=folder) as scratch:
            yield Path(scratch)
    except OSError as error:
        raise VehicleError(f"{path}: cannot be written ({error.strerror or error})") from None


def inside(folder: Path, name: str) -> Path:
    """The path of a file that must lie in the folder.

    Raises:
        VehicleError: the name leads out of the folder.
    """
    path = folder / name
    if "\0" in name or not path.resolve().is_relative_to(folder.resolve()):
        raise VehicleError(f"found {quoted(name)}, expected a file inside the vehicle folder")
    return path


def file_stems(names: Iterable[str]) -> dict[str, str]:
    """For each name a file name without suffix, different from the others."""
    stems: dict[str, str] = {}
    for name in names:
        slug = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_") or "unnamed"
        taken = sum(re.sub(r"-\d+$", "", stem) == slug for stem in stems.values())
        stems[name] = f"{slug}-{taken + 1}" if taken else slug
    return stems


def replace_folder(folder: Path, fill: Callable[[Path], None]) -> None:
    """Makes the folder anew, or leaves it as it was if that fails.

    Args:
        folder: what to make.
        fill: writes the content into the folder it is given.

    Raises:
        VehicleError: it cannot be written.
    """
    folder = folder.resolve()
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(prefix=f".{folder.name}-", dir=folder.parent) as scratch:
            new, old = Path(scratch, "new"), Path(scratch, "old")
            new.mkdir()
            fill(new)
            if folder.exists():
                folder.rename(old)
            _move_or_restore(new, folder, old)
    except OSError as error:
        raise VehicleError(f"{folder}: cannot be written ({error})") from None


def _move_or_restore(new: Path, folder: Path, old: Path) -> None:
    try:
        new.rename(folder)
    except OSError:
        if old.exists():
            old.rename(folder)
        raise
