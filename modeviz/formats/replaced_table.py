"""The table of a body in a vehicle's file, brought up to a new import of that body."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from modeviz.errors import VehicleError, located, quoted, unknown
from modeviz.files.key_lines import key_lines
from modeviz.files.toml_reader import tables_of

MODES = re.compile(r"bodies/([\w-]+)\.npz")

OF_THE_MODES = ("modes", "mesh", "units", "damping_ratio")
"""Keys that an import knows better than what stands there."""

OF_THE_MESH = ("mesh_unit", "mesh_axes")
"""Keys that say of another mesh what that of an import needs not."""

COMMENT = re.compile(r"# attachment |#mass = ")
"""Begins comments that an import writes into a table."""

ORIGIN = re.compile(r"# \d+ modes from ")
"""Begins the one that it writes above it."""


def replaced_stem(text: str, name: str, path: Path) -> str:
    """Return what the files of a body are called, without their endings.

    Args:
        text: of the vehicle's file.
        name: of the body.
        path: of the vehicle's file.

    Raises:
        VehicleError: it has no such flexible body, or one whose modes are in a file of another kind.
    """
    modes = str(_table(text, name, path)[1].get("modes", ""))
    if found := MODES.fullmatch(modes):
        return found[1]
    raise VehicleError(
        f"{path}: body {quoted(name)}: found the modes {quoted(modes)}, expected bodies/NAME.npz to "
        "replace them"
    )


def with_table(text: str, name: str, written: Sequence[str], path: Path) -> str:
    """Return the text of a vehicle's file in which a body is as an import writes it.

    All that an import does not know stays to the letter, a damping ratio of all modes too.

    Args:
        text: of the file.
        name: of the flexible body.
        written: the lines of its table, as for a new one.
        path: of the file.

    Raises:
        VehicleError: there is no such body, or its table is written so that no lines can be replaced.
    """
    number, table = _table(text, name, path)
    lines = text.splitlines(keepends=True)
    block = _block(text, number, len(lines))
    if not {"name", "modes"} <= set(block.keys):
        raise VehicleError(
            f"{path}: body {quoted(name)}: expected a table under [[flexible_body]] with a line for "
            "each key, to replace it"
        )
    changed = _changed(table, written)
    for key in changed:
        if key in block.keys:
            with located(f"{path}: {key}: to be replaced it has to be on one line"):
                tables_of(lines[block.keys[key]])
    _put_keys(lines, block, changed)
    _put_comments(lines, block, written)
    return "".join(lines)


@dataclass(frozen=True)
class _Block:
    """Where a table stands among the lines of a file, all from zero."""

    first: int
    """Its header."""
    end: int
    """Behind its last line."""
    keys: dict[str, int]


def _table(text: str, name: str, path: Path) -> tuple[int, dict[str, Any]]:
    """Which of the flexible bodies one is, and its table."""
    with located(path):
        bodies = tables_of(text).get("flexible_body", [])
    names = [str(body.get("name", "")) for body in bodies]
    if not names:
        raise VehicleError(f"{path.parent}: has no flexible body; --replace needs one")
    if name not in names:
        raise VehicleError(f"{path}: {unknown('flexible body', name, names)}; --replace needs one")
    return names.index(name), bodies[names.index(name)]


def _block(text: str, number: int, n_lines: int) -> _Block:
    """Where the table of one of the flexible bodies stands."""
    table = f"flexible_body[{number}]"
    places = [(path, line - 1) for path, line in key_lines(text)]
    first = next((line for path, line in places if path == table), -1)
    keys = {
        path.removeprefix(f"{table}."): line for path, line in places if path.startswith(f"{table}.")
    }
    after = (line for path, line in places if line > first and not path.startswith(table))
    return _Block(first, next(after, n_lines), keys)


def _changed(table: dict[str, Any], written: Sequence[str]) -> dict[str, str]:
    """The lines of keys that are to be other than they are, empty for those that are to go."""
    changed = {}
    for key in OF_THE_MODES:
        line = next((line for line in written if line.startswith(f"{key} = ")), None)
        stays = key == "damping_ratio" and not isinstance(table.get(key), list)
        if line is not None and not stays and tables_of(line)[key] != table.get(key):
            changed[key] = f"{line}\n"
    has_mesh = any(line.startswith("mesh = ") for line in written)
    return changed | {key: "" for key in OF_THE_MESH if has_mesh and key in table}


def _put_keys(lines: list[str], block: _Block, changed: dict[str, str]) -> None:
    """Puts changed lines in the place of those of their keys, new ones after that of the modes."""
    for key, line in changed.items():
        if key in block.keys:
            lines[block.keys[key]] = line
        else:
            lines[block.keys["modes"]] = _ended(lines[block.keys["modes"]]) + line


def _put_comments(lines: list[str], block: _Block, written: Sequence[str]) -> None:
    """Puts the comments of an import in the place of those of the one before."""
    old = [i for i in range(block.first, block.end) if COMMENT.match(lines[i])]
    for i in old:
        lines[i] = ""
    at = old[0] if old else max(block.keys.values())
    lines[at] = _ended(lines[at]) + "".join(f"{line}\n" for line in written if COMMENT.match(line))
    if block.first and ORIGIN.match(lines[block.first - 1]):
        lines[block.first - 1] = f"{written[0]}\n"


def _ended(line: str) -> str:
    return line if not line or line.endswith("\n") else f"{line}\n"
