"""Frequency responses and power spectra at the response points, one function for each direction."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from modeviz.analysis.driven import driven
from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Conditions, solve
from modeviz.dynamics.resonances import resonances_at
from modeviz.errors import VehicleError
from modeviz.export.axes import FileAxes
from modeviz.ride.excitation import Load
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.loads import BaseMotion, Force, Road, WheelLoad
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle

InputQuantity = Literal["displacement", "force", "acceleration", "unbalance"]

UNITS: dict[InputQuantity, str] = {
    "displacement": "m",
    "force": "N",
    "acceleration": "m/s^2",
    "unbalance": "kg m",
}
"""Of one of an input."""


@dataclass(frozen=True)
class Input:
    """What a frequency response is to."""

    name: str
    """Of a load; of a road with its track."""
    quantity: InputQuantity
    along: int
    """Along which axis of the vehicle's file it is, 1 to 3, below zero if against it; 0: none."""


@dataclass(frozen=True, eq=False)
class Function:
    """The acceleration of a response point along one axis, over frequency."""

    point: int
    """Its number among the vehicle's response points."""
    axis: int
    """0 to 2: along x, y, z of the vehicle's file."""
    values: Array
    """(n_freqs,): a PSD, (m/s²)²/Hz, or complex, m/s² per unit of the input."""
    reference: Input | None = None
    """None: it is a PSD."""


@dataclass(frozen=True, eq=False)
class Functions:
    """Functions at the same frequencies."""

    vehicle: Vehicle
    axes: FileAxes
    about: str
    """Under what."""
    frequency_hz: Floats
    """(n_freqs,), rising."""
    functions: tuple[Function, ...]

    def title(self, function: Function) -> str:
        """Return what a function is: "seat vertical (z)", "seat lateral (y) / road 1, left track"."""
        point = self.vehicle.response_points[function.point].name
        named = f"{point} {self.axes.directions[function.axis]} ({'xyz'[function.axis]})"
        return f"{named} / {function.reference.name}" if function.reference else named


def power_spectra(prepared: Prepared, rates: Rates, conditions: Conditions) -> Functions:
    """Return the PSDs of a ride; arguments and errors as `analysis.results.solve`."""
    results = solve(prepared, rates, conditions)
    axes = FileAxes(prepared.vehicle.axes)
    psd = results.psd * STANDARD_GRAVITY**2
    functions = tuple(
        Function(point, abs(axes.signed(axis)) - 1, psd[:, point, axis])
        for point in range(psd.shape[1])
        for axis in range(3)
    )
    about = f"{conditions.road} at {conditions.speed:.6g} m/s"
    return Functions(prepared.vehicle, axes, about, results.frequency_hz, _ordered(functions))


def frequency_responses(prepared: Prepared, rates: Rates, conditions: Conditions | None) -> Functions:
    """Return the accelerations per unit of each input that the vehicle has.

    Of a road these are the displacements of its two tracks, the rear wheels following the front ones;
    of wheel loads, forces and motions of the ground what their amplitudes are of.

    Args:
        prepared: the vehicle.
        rates: of its mounts.
        conditions: of the road; None: without one.

    Raises:
        VehicleError: it has no input.
        SolveError: with these rates an undamped resonance lies on a frequency.
    """
    vehicle, axes = prepared.vehicle, FileAxes(prepared.vehicle.axes)
    loads = list(_unit_loads(vehicle, conditions))
    inputs = [one for load in loads for one in _inputs(load, axes)]
    if not inputs:
        raise VehicleError(
            f"vehicle {vehicle.name!r} has no load: give its vehicle.toml a [[tyre]] or a [[force]]"
        )
    stiffness = prepared.mount_stiffness(rates)
    under = driven(prepared, loads, conditions.speed if conditions else vehicle.speed)
    f = under.lines(resonances_at(prepared.basis, stiffness))
    H = -((2 * np.pi * f[:, None, None]) ** 2) * under.response(stiffness, f)
    functions = (
        Function(
            output // 3,
            abs(axes.signed(output % 3)) - 1,
            np.sign(axes.signed(output % 3)) * H[:, output, number],
            one,
        )
        for number, one in enumerate(inputs)
        for output in range(H.shape[1])
    )
    about = f"at {conditions.speed:.6g} m/s" if conditions else "standing"
    return Functions(vehicle, axes, about, f, _ordered(functions))


def check_felt(vehicle: Vehicle) -> None:
    """Raises VehicleError unless somebody feels what the vehicle does."""
    if not vehicle.response_points:
        raise VehicleError(
            f"vehicle {vehicle.name!r} has no response point: give its vehicle.toml a "
            "[[response_point]]"
        )


def _ordered(functions: Iterator[Function] | Sequence[Function]) -> tuple[Function, ...]:
    """Input by input, point by point, along x, y, z of the file; the order of inputs stays."""
    every = list(functions)
    inputs = list(dict.fromkeys(function.reference for function in every))
    return tuple(sorted(every, key=lambda f: (inputs.index(f.reference), f.point, f.axis)))


def _unit_loads(vehicle: Vehicle, conditions: Conditions | None) -> Iterator[Load]:
    """The road, and every other load of the vehicle with an amplitude of one."""
    road = vehicle.random_load(conditions.road) if conditions else None
    if isinstance(road, Road):
        yield road
    for load in (*vehicle.wheel_loads, *vehicle.forces, *vehicle.base_motions):
        yield replace(load, amplitude=1.0)


def _inputs(load: Load, axes: FileAxes) -> Iterator[Input]:
    match load:
        case Road():
            for track in ("left", "right"):
                yield Input(f"{load.name}, {track} track", "displacement", axes.signed(2))
        case WheelLoad():
            yield Input(load.name, "unbalance" if load.kind == "unbalance" else "force", 0)
        case Force():
            yield Input(load.name, "force", _along(load.direction, axes))
        case BaseMotion():
            yield Input(load.name, load.quantity, _along(load.direction, axes))


def _along(direction: Floats, axes: FileAxes) -> int:
    """The axis of the file that a direction, of length one, is along; 0 if it is along none."""
    axis = int(np.abs(direction).argmax())
    is_along = abs(abs(direction[axis]) - 1) < 1e-9
    return int(np.sign(direction[axis])) * axes.signed(axis) if is_along else 0
