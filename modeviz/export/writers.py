"""What makes the content of files: a writer for each content and format."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial

from modeviz.errors import VehicleError
from modeviz.export.arrays import body_file, modes_arrays
from modeviz.export.axes import FileAxes
from modeviz.export.bushes import bush_deck
from modeviz.export.drawn import drawn_bodies
from modeviz.export.folder import zipped_folder
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
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

Writer = Callable[[Solution, ExportOptions], bytes]
"""Gives the content of a file."""

Modes = Callable[[Solution, ExportOptions], ShapeSet]
"""Gives the modes that a file has."""

DECKS = (".bdf", ".dat", ".nas")
"""Endings of Nastran input files."""

MODE_SETS = {".unv": 2414, ".uff": 55}
"""The data set of a mode in a universal file, by its ending: as solvers write it, or test systems."""


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


def of_body(body: Body) -> dict[str, Writer]:
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


def _folder(solution: Solution, _: ExportOptions) -> bytes:
    return zipped_folder(solution.vehicle)


WHOLE: Mapping[str, Mapping[str, Writer]] = {
    "vehicle": {".zip": _folder},
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
