"""The command that writes files for other programs."""

import shlex
from argparse import ArgumentParser
from dataclasses import dataclass, replace
from pathlib import Path

from modeviz.cli.command import Command
from modeviz.cli.options import RoadOptions, VehicleOptions, add_road, add_vehicle
from modeviz.cli.terminal import Teller, remark, say
from modeviz.errors import ModevizError
from modeviz.export.catalogue import ENDINGS
from modeviz.export.solution import ExportOptions
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.study.exporting import export_files
from modeviz.study.tuned_vehicle import TunedVehicle


@dataclass(frozen=True, kw_only=True)
class ExportCommandOptions(VehicleOptions, ExportOptions, RoadOptions):
    """What `modeviz export` is asked for."""

    files: tuple[Path, ...]
    """Their names say what they have: "rates.bdf"."""

    @property
    def begins_with_a_file(self) -> bool:
        """Whether what stands in the place of the vehicle is named as a file that is to be written."""
        first = self.vehicle
        return first is not None and first.suffix.lower() in ENDINGS and not first.is_dir()


def export(options: ExportCommandOptions) -> None:
    """Writes files of a vehicle with its rates, and prints which.

    Raises:
        ModevizError: the vehicle comes after the files, or as `export_files`.
    """
    if options.begins_with_a_file:
        files = tuple(filter(None, (options.vehicle, *options.files)))
        for path in options.files:
            if path.is_dir():
                raise ModevizError(
                    f"{path}: is a folder; that of the vehicle comes first: modeviz export "
                    f"{shlex.join(map(str, (path, files[0])))}"
                )
        options = replace(options, vehicle=None, files=files)
    vehicle, rates = options.read()
    tuned = TunedVehicle(vehicle, Teller())
    tuned.rates.use(rates)
    tuned.speed = options.chosen_speed(vehicle)
    try:
        export_files(options.files, tuned, options.road, options, remark)
    finally:
        say("")
    print(*options.files, sep="\n")


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    command.add_argument(
        "files",
        nargs="+",
        type=Path,
        metavar="FILE",
        help="its name ends in what it has, and says the format: rates.csv, rates.bdf, modes.unv, "
        "optimised-psd.csv, cab.vtu; docs/export.md lists them",
    )
    command.add_argument(
        "--below",
        type=float,
        metavar="HZ",
        dest="below_hz",
        help="modes above are left out (default: those above the vehicle's band)",
    )
    command.add_argument(
        "--mode", metavar="NAME", help='of a motion, such as "cab yaw" (default: the lowest)'
    )
    command.add_argument(
        "--units",
        metavar="NAME",
        help=f"of Nastran cards: {', '.join(UNIT_SYSTEMS)} (default mm-t-s); all else is in SI",
    )
    command.add_argument(
        "--first-id",
        type=int,
        metavar="N",
        help="of the grids, elements, properties and coordinate systems in Nastran cards (default 1)",
    )
    add_road(command)


EXPORT = Command(
    "export",
    "rates, modes, responses and bodies as files for other programs",
    ExportCommandOptions,
    _add_options,
    export,
)
