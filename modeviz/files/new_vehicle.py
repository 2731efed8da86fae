"""Small vehicle folders to begin with: bodies and mounts in tables, with numbers that make sense."""

from pathlib import Path
from typing import Literal, get_args

from modeviz.errors import VehicleError, located, quoted, reason, unknown

Kind = Literal["powertrain", "cab", "cab-on-frame", "machine"]
"""powertrain: a four-cylinder with its gearbox, across the car on three mounts. cab: a truck's, on four
spring-dampers. cab-on-frame: the same on a frame that stands on its tyres. machine: on four feet."""

TEMPLATES = Path(__file__).parent / "templates"
"""A folder for each kind."""


def new_vehicle(kind: Kind, folder: Path | str) -> Path:
    """Return the folder of a new vehicle, which is written with two tables to fill in.

    Args:
        kind: what it is to begin as.
        folder: where; it may be there if it is empty.

    Raises:
        VehicleError: no such kind, or there is something in the folder, which is never overwritten.
    """
    if kind not in get_args(Kind):
        raise VehicleError(unknown("kind of vehicle", kind, get_args(Kind)))
    folder = Path(folder)
    with located(folder):
        _check_is_free(folder)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            for template in sorted((TEMPLATES / kind).iterdir()):
                with (folder / template.name).open("x", encoding="utf-8", newline="\n") as file:
                    file.write(template.read_text("utf-8"))
        except OSError as error:
            raise VehicleError(f"cannot be written ({reason(error)})") from None
    return folder


def _check_is_free(folder: Path) -> None:
    """Raises VehicleError if there is a file, or a folder with something in it."""
    if folder.is_dir():
        if found := sorted(path.name for path in folder.iterdir()):
            raise VehicleError(
                f"there is {quoted(found[0])} in it already, and nothing is overwritten; give a new or "
                "an empty folder"
            )
    elif folder.exists():
        raise VehicleError("is a file, and nothing is overwritten; give a new or an empty folder")
