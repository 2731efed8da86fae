"""What can be written, by the name of the file: "rates.bdf", "optimised-modes.unv", "cab.glb"."""

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial
from itertools import chain, count
from pathlib import Path

from modeviz.errors import ModevizError, VehicleError, listed, quoted
from modeviz.export.arrays import body_file, modes_arrays
from modeviz.export.axes import FileAxes
from modeviz.export.bushes import bush_deck
from modeviz.export.drawn import drawn_bodies
from modeviz.export.function_table import function_table
from modeviz.export.functions import Functions, check_felt, frequency_responses, power_spectra
from modeviz.export.glb import bodies_glb
from modeviz.export.mount_table import mount_table
from modeviz.export.points import Points, body_points, vehicle_points
from modeviz.export.shapes import ShapeSet, body_modes, complex_modes, one_of, vehicle_modes
from modeviz.export.solution import ExportOptions, Solution
from modeviz.export.universal.functions import functions_file
from modeviz.export.universal.modes import modes_file
from modeviz.export.vtu import motion_file, vtu_file
from modeviz.files.rate_files import rates_text
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.connections import MountRates
from modeviz.vehicle.vehicle import Vehicle

Writer = Callable[[Solution, ExportOptions], bytes]
"""Gives the content of a file."""

DECKS = (".bdf", ".dat", ".nas")
"""Endings of Nastran input files."""

MODE_SETS = {".unv": 2414, ".uff": 55}
"""The data set of a mode in a universal file, by its ending: as solvers write it, or test systems."""


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
    words = body_words(vehicle)
    return {**{words[body.name]: _of_body(body) for body in vehicle.bodies}, **WHOLE}


def body_words(vehicle: Vehicle) -> dict[str, str]:
    """Return what file names call each body: its name in small letters, with "-" between words."""
    words: dict[str, str] = {}
    for body in vehicle.bodies:
        slug = _slug(body.name) or "body"
        numbered = (f"{slug}-{number}" for number in count(2))
        taken = {*words.values(), *WHOLE}
        words[body.name] = next(word for word in chain([slug], numbered) if word not in taken)
    return words


def _slug(name: str) -> str:
    """A name in small letters and digits, with "-" for all between."""
    return re.sub(r"[\W_]+", "-", name.lower()).strip("-")


def _mounted(solution: Solution) -> Vehicle:
    """The vehicle, which has mounts; raises VehicleError if it has none."""
    if not solution.vehicle.mount_groups:
        raise VehicleError(
            f"vehicle {solution.vehicle.name!r} has no mount group: give its vehicle.toml a "
            "[[mount_group]]"
        )
    return solution.vehicle


def _rates_by_group(solution: Solution) -> dict[str, MountRates]:
    """The rates of every mount group with their loss factors."""
    groups = _mounted(solution).mount_groups
    return {group.name: replace(group.rates, loss_factor=group.loss_factor) for group in groups}


def _rates_csv(solution: Solution, _: ExportOptions) -> bytes:
    return rates_text(_rates_by_group(solution), "csv").encode()


def _rates_json(solution: Solution, _: ExportOptions) -> bytes:
    return rates_text(_rates_by_group(solution), "json").encode()


def _deck(solution: Solution, options: ExportOptions) -> bytes:
    return bush_deck(_mounted(solution), UNIT_SYSTEMS[options.units], options.first_id)


def _table(solution: Solution, _: ExportOptions) -> bytes:
    return mount_table(_mounted(solution))


Modes = Callable[[Solution, ExportOptions], ShapeSet]


def _below(solution: Solution, options: ExportOptions) -> float:
    return options.below_hz or solution.vehicle.highest_frequency


def _real(solution: Solution, options: ExportOptions) -> ShapeSet:
    below = _below(solution, options)
    return vehicle_modes(solution.modes(below), below)


def _complex(solution: Solution, options: ExportOptions) -> ShapeSet:
    below = _below(solution, options)
    return complex_modes(solution.modes(below), below, solution.note)


def _modes_universal(number: int, modes: Modes, solution: Solution, options: ExportOptions) -> bytes:
    vehicle = solution.vehicle
    points, axes = vehicle_points(vehicle), FileAxes(vehicle.axes)
    return modes_file(vehicle.name, points, modes(solution, options), axes, number)


def _modes_npz(modes: Modes, solution: Solution, options: ExportOptions) -> bytes:
    vehicle = solution.vehicle
    return modes_arrays(vehicle_points(vehicle), modes(solution, options), FileAxes(vehicle.axes))


def _vtu(modes: Modes | None, solution: Solution, options: ExportOptions) -> bytes:
    vehicle = solution.vehicle
    drawn = drawn_bodies(vehicle, vehicle.bodies)
    shapes = modes(solution, options) if modes else None
    return vtu_file(vehicle.name, drawn, shapes, FileAxes(vehicle.axes))


def _motion(solution: Solution, options: ExportOptions) -> bytes:
    vehicle = solution.vehicle
    mode = one_of(_real(solution, options), options.mode)
    drawn = drawn_bodies(vehicle, vehicle.bodies)
    return motion_file(vehicle.name, drawn, mode, FileAxes(vehicle.axes))


def _of_modes(modes: Modes) -> dict[str, Writer]:
    """The formats of modes of the vehicle."""
    universal = {
        ending: partial(_modes_universal, number, modes) for ending, number in MODE_SETS.items()
    }
    return {**universal, ".npz": partial(_modes_npz, modes), ".vtu": partial(_vtu, modes)}


def _bodies_glb(solution: Solution, _: ExportOptions) -> bytes:
    return bodies_glb(solution.vehicle.bodies)


def _of_body(body: Body) -> dict[str, Writer]:
    """The formats of one body."""
    its: dict[str, Writer] = {
        ".glb": lambda *_: bodies_glb([body]),
        ".vtu": partial(_body_vtu, body),
    }
    if isinstance(body, FlexibleBody):
        its |= {ending: partial(_body_universal, n, body) for ending, n in MODE_SETS.items()}
        its[".npz"] = partial(_body_npz, body)
    return its


def _body_vtu(body: Body, solution: Solution, _: ExportOptions) -> bytes:
    modes = body_modes(body) if isinstance(body, FlexibleBody) else None
    drawn = drawn_bodies(solution.vehicle, [body])
    return vtu_file(body.name, drawn, modes, FileAxes(solution.vehicle.axes))


def _body_universal(number: int, body: FlexibleBody, solution: Solution, _: ExportOptions) -> bytes:
    points = Points((body_points(solution.vehicle, body),))
    return modes_file(body.name, points, body_modes(body), FileAxes(solution.vehicle.axes), number)


def _body_npz(body: FlexibleBody, solution: Solution, _: ExportOptions) -> bytes:
    return body_file(body, FileAxes(solution.vehicle.axes))


def _responses(solution: Solution) -> Functions:
    check_felt(solution.vehicle)
    return frequency_responses(solution.prepared(), solution.rates, solution.ride)


def _spectra(solution: Solution) -> Functions:
    check_felt(solution.vehicle)
    conditions = solution.conditions()  # what is wrong there is better said before preparing
    return power_spectra(solution.prepared(), solution.rates, conditions)


def _of_functions(functions: Callable[[Solution], Functions]) -> dict[str, Writer]:
    """The formats of functions over frequency."""
    return {
        ".csv": lambda solution, _: function_table(functions(solution)),
        **_as(MODE_SETS, lambda solution, _: functions_file(functions(solution))),
    }


def _as(endings: Iterable[str], make: Writer) -> dict[str, Writer]:
    return dict.fromkeys(endings, make)


WHOLE: Mapping[str, Mapping[str, Writer]] = {
    "rates": {".csv": _rates_csv, ".json": _rates_json, **_as(DECKS, _deck)},
    "mounts": {".csv": _table, **_as(DECKS, _deck)},
    "modes": _of_modes(_real),
    "complex-modes": _of_modes(_complex),
    "motion": {".vtu": _motion},
    "psd": _of_functions(_spectra),
    "frf": _of_functions(_responses),
    "bodies": {".glb": _bodies_glb, ".vtu": partial(_vtu, None)},
}
"""What can be written of any vehicle."""

ENDINGS = frozenset(ending for formats in WHOLE.values() for ending in formats)
"""Of all files that can be written."""
