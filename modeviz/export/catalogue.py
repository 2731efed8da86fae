"""What can be written, by the name of the file: "rates.bdf", "optimised-modes.unv", "cab.glb"."""

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from modeviz.errors import ModevizError, VehicleError, listed, quoted
from modeviz.export.bushes import bush_deck
from modeviz.export.mount_table import mount_table
from modeviz.export.solution import ExportOptions, Solution
from modeviz.files.rate_files import rates_text
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.vehicle.connections import MountRates
from modeviz.vehicle.vehicle import Vehicle

Writer = Callable[[Solution, ExportOptions], bytes]
"""Gives the content of a file."""

DECKS = (".bdf", ".dat", ".nas")
"""Endings of Nastran input files."""


def writer(path: Path, vehicle: Vehicle) -> Writer:
    """Return what makes the content of a file: its name ends in what it has, and says the format.

    Args:
        path: such as "modes.unv" or "optimised rates.csv".
        vehicle: whose it is.

    Raises:
        ModevizError: its name says nothing that there is, or not in that format.
    """
    words = contents(vehicle)
    stem, suffix = _slug(path.stem), path.suffix.lower()
    word = max((w for w in words if f"-{stem}".endswith(f"-{w}")), key=len, default=None)
    if word is None:
        raise ModevizError(
            f"found {quoted(path.name)}, expected a name that ends in what the file is to have: "
            f"{listed(words)}; such as rates.bdf or optimised-modes.unv"
        )
    if suffix not in words[word]:
        raise ModevizError(
            f"found {quoted(path.name)}, expected {word} as one of {', '.join(words[word])}"
        )
    return words[word][suffix]


def contents(vehicle: Vehicle) -> dict[str, Mapping[str, Writer]]:
    """Return what can be written of a vehicle, and for each the writers by the ending of the file."""
    return dict(WHOLE)


def _slug(name: str) -> str:
    """A name in small letters and digits, with "-" for all between."""
    return re.sub(r"[\W_]+", "-", name.lower()).strip("-")


def _of_mounts(solution: Solution) -> Vehicle:
    """The vehicle, which has mounts; raises VehicleError if it has none."""
    if not solution.vehicle.mount_groups:
        raise VehicleError(
            f"vehicle {solution.vehicle.name!r} has no mount group: give its vehicle.toml a "
            "[[mount_group]]"
        )
    return solution.vehicle


def _rates_by_group(solution: Solution) -> dict[str, MountRates]:
    """The rates of every mount group with their loss factors."""
    groups = _of_mounts(solution).mount_groups
    return {group.name: replace(group.rates, loss_factor=group.loss_factor) for group in groups}


def _rates_csv(solution: Solution, _: ExportOptions) -> bytes:
    return rates_text(_rates_by_group(solution), "csv").encode()


def _rates_json(solution: Solution, _: ExportOptions) -> bytes:
    return rates_text(_rates_by_group(solution), "json").encode()


def _deck(solution: Solution, options: ExportOptions) -> bytes:
    return bush_deck(_of_mounts(solution), UNIT_SYSTEMS[options.units], options.first_id)


def _table(solution: Solution, _: ExportOptions) -> bytes:
    return mount_table(_of_mounts(solution))


def _as(endings: Iterable[str], make: Writer) -> dict[str, Writer]:
    return dict.fromkeys(endings, make)


WHOLE: Mapping[str, Mapping[str, Writer]] = {
    "rates": {".csv": _rates_csv, ".json": _rates_json, **_as(DECKS, _deck)},
    "mounts": {".csv": _table, **_as(DECKS, _deck)},
}
"""What can be written of any vehicle."""

ENDINGS = frozenset(ending for formats in WHOLE.values() for ending in formats)
"""Of all files that can be written."""
