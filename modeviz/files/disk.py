"""Files and folders, with errors a user can act on."""

import codecs
import os
import re
import stat
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from difflib import get_close_matches
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import BinaryIO

from modeviz.errors import MOST_COMPARED, VehicleError, located, quoted, reason
from modeviz.files.limits import check_size, most_allowed

LARGEST_TEXT = 2_000_000
"""Bytes of a file of tables and keys: a hundred times the truck's."""

LARGEST_TABLE = 20_000_000
"""Bytes of comma-separated text."""

_confines: ContextVar[Path | None] = ContextVar("confines", default=None)
"""The folder outside of which nothing is read."""

WESTERN = "cp1252"
"""In which spreadsheets write text that is not UTF-8."""


def read_bytes(path: Path, most: int) -> bytes:
    """The content of a file.

    Args:
        path: of the file.
        most: how many bytes are read of it; more are refused before they are.

    Raises:
        VehicleError: it is not there, too large, endless, or cannot be read.
    """
    with opened(path, most) as file:
        size = os.fstat(file.fileno()).st_size  # what `read` makes room for
        return file.read(min(size, most_allowed(most)))


@contextmanager
def confined_to(folder: Path) -> Iterator[None]:
    """While this lasts, no file outside a folder is read here: what is in it may be a stranger's."""
    before = _confines.set(folder.resolve())
    try:
        yield
    finally:
        _confines.reset(before)


@contextmanager
def opened(path: Path, most: int) -> Iterator[BinaryIO]:
    """A file to be read, see `read_bytes`."""
    confines = _confines.get()
    if confines is not None and not path.resolve().is_relative_to(confines):
        raise VehicleError(f"{path.name}: is in another folder, where nothing is read for a page")
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode):  # opening a pipe would wait for ever
            raise VehicleError(f"{path}: cannot be read (a folder, pipe or device, expected a file)")
        with located(path):
            check_size("bytes", status.st_size, most)
        file = path.open("rb")
    except FileNotFoundError:
        raise VehicleError(f"{path}: there is no such file{_likely(path)}") from None
    except (OSError, ValueError, RuntimeError) as error:
        raise VehicleError(f"{path}: cannot be read ({reason(error)})") from None
    with file:
        yield file


def check_each_once(paths: Iterable[Path]) -> None:
    """Checks that no file is there twice, by whatever way.

    Raises:
        VehicleError: one is.
    """
    seen: set[str] = set()
    for path in paths:
        whole = os.path.abspath(path)
        if whole in seen:
            raise VehicleError(f"{path}: found twice, expected each file once")
        seen.add(whole)


def _likely(path: Path) -> str:
    """Words for the file that may be meant by a path at which there is none."""
    try:
        names = [other.name for other in path.parent.iterdir()]
    except OSError:
        return f", nor a folder {path.parent}" if path.parent.name else ""
    close = [
        name
        for name in get_close_matches(path.name, names[:MOST_COMPARED])
        if get_close_matches(path.stem, [Path(name).stem])  # endings are alike of files that are not
    ]
    return f"; did you mean {quoted(close[0])}?" if close else ""


def read_text(path: Path, most: int = LARGEST_TEXT, otherwise: str | None = None) -> str:
    """The content of a text file in UTF-8, or in UTF-16 if it begins so; no byte order mark is left.

    Args:
        path: of the file.
        most: how many bytes are read of it.
        otherwise: in what it is written if it is neither; None where nothing else may be.

    Raises:
        VehicleError: as `read_bytes`, or no such text.
    """
    content = read_bytes(path, most)
    is_wide = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    if b"\0" in content and not is_wide:
        raise VehicleError(
            f"{path}: found no text, such as in a workbook of a spreadsheet; save it as text"
        )
    try:
        return content.decode("utf-16" if is_wide else "utf-8-sig")
    except UnicodeDecodeError as error:
        if otherwise and not is_wide:
            return content.decode(otherwise, errors="replace")
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
        raise VehicleError(f"{path}: cannot be written ({reason(error)})") from None


def inside(folder: Path, name: str, what: str = "the vehicle folder") -> Path:
    """The path of a file that must lie in the folder, which is `what` in words.

    Raises:
        VehicleError: the name leads out of the folder.
    """
    path = folder / name
    try:
        leads_out = "\0" in name or not path.resolve().is_relative_to(folder.resolve())
    except (OSError, RuntimeError) as error:  # a link to itself
        raise VehicleError(f"found {quoted(name)}, which leads nowhere ({reason(error)})") from None
    if leads_out:
        raise VehicleError(f"found {quoted(name)}, expected a file inside {what}")
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
        raise VehicleError(f"{folder}: cannot be written ({reason(error)})") from None


def _move_or_restore(new: Path, folder: Path, old: Path) -> None:
    try:
        new.rename(folder)
    except OSError:
        if old.exists():
            old.rename(folder)
        raise
