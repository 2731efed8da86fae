"""The command that writes a small vehicle folder to begin with."""

from argparse import ArgumentParser
from dataclasses import dataclass
from pathlib import Path
from typing import get_args

from modeviz.cli.command import Command
from modeviz.cli.results import check_printable, print_result
from modeviz.files.new_vehicle import Kind, new_vehicle


@dataclass(frozen=True, kw_only=True)
class NewOptions:
    """What `modeviz new` is asked for."""

    kind: Kind
    folder: Path


def write_new(options: NewOptions) -> None:
    """Writes the folder, and prints what is in it and what to do next."""
    check_printable()
    folder = new_vehicle(options.kind, options.folder)
    names = ", ".join(sorted(path.name for path in folder.iterdir()))
    print_result(
        f"{folder}: {names}\n"
        "Edit the tables in a spreadsheet; their headers say the units.\n"
        f"  modeviz check {folder}   lists what is wrong, and sums it up\n"
        f"  modeviz view {folder}    opens it"
    )


def _add_options(command: ArgumentParser) -> None:
    command.add_argument("kind", choices=get_args(Kind), help="what to begin with")
    command.add_argument("folder", type=Path, metavar="FOLDER", help="new, or empty")


NEW = Command(
    "new", "write a small vehicle with tables of bodies and mounts", NewOptions, _add_options, write_new
)
