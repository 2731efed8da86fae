"""The modes that are written: of a vehicle, real or with their damping, or of one of its bodies."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from modeviz.analysis.deflection_shapes import complex_mode
from modeviz.analysis.modal_results import ModalResults
from modeviz.dynamics.assembly import System
from modeviz.dynamics.damped import DampedMode
from modeviz.dynamics.modes import RESOLVED_HZ
from modeviz.errors import SolveError, VehicleError, unknown
from modeviz.vehicle.arrays import Array, Complexes, Floats
from modeviz.vehicle.bodies import FlexibleBody


@dataclass(frozen=True, eq=False)
class ShapeSet:
    """Mass-normalised modes in the coordinates of bodies."""

    names: tuple[str, ...]
    """What moves: "cab yaw"."""
    numbers: tuple[int, ...]
    """From one, as modeviz counts them."""
    frequency_hz: Floats
    """(n_modes,): undamped; |λ|/2π of those with their damping."""
    damping_ratio: Floats
    """(n_modes,), fractions of critical."""
    loss_factor: float
    """Structural damping besides, of a body alone."""
    coordinates: Array
    """(n_dofs, n_modes), real or complex."""
    dofs: Mapping[str, slice]
    """Which coordinates are whose, by the body's name."""
    eigenvalue: Complexes | None = None
    """λ, (n_modes,), rad/s, of complex modes: motion goes as e^{λt}."""
    modal_a: Complexes | None = None
    """(n_modes,), kg rad/s: ψᵀ(2λM + C)ψ of complex modes; the modal B is -λ times that."""
    n_residuals: int = 0
    """How many of the last are residual vectors, of a body alone."""


def vehicle_modes(results: ModalResults, below_hz: float) -> ShapeSet:
    """Return the undamped modes of a vehicle below a frequency, Hz."""
    modes = results.modes
    chosen = np.flatnonzero(modes.frequency_hz < below_hz)
    return ShapeSet(
        tuple(results.names[i].name for i in chosen),
        tuple(int(i) + 1 for i in chosen),
        modes.frequency_hz[chosen],
        modes.damping_ratio[chosen],
        0.0,
        modes.shapes[:, chosen],
        results.system.dofs,
    )


def one_of(modes: ShapeSet, name: str) -> ShapeSet:
    """Return one of real modes.

    Args:
        modes: of a vehicle.
        name: of it; "": the lowest that vibrates.

    Raises:
        VehicleError: none has that name, or none vibrates.
    """
    vibrating = np.flatnonzero(modes.frequency_hz > RESOLVED_HZ).tolist()
    if name and name not in modes.names:
        raise VehicleError(unknown("mode", name, modes.names))
    if not name and not vibrating:
        raise VehicleError("no mode vibrates")
    number = modes.names.index(name) if name else vibrating[0]
    chosen = slice(number, number + 1)
    return replace(
        modes,
        names=modes.names[chosen],
        numbers=modes.numbers[chosen],
        frequency_hz=modes.frequency_hz[chosen],
        damping_ratio=modes.damping_ratio[chosen],
        coordinates=modes.coordinates[:, chosen],
    )


def complex_modes(results: ModalResults, below_hz: float, note: Callable[[str], None]) -> ShapeSet:
    """Return the modes of a vehicle with their damping, those of undamped ones below a frequency.

    Args:
        results: of the vehicle.
        below_hz: Hz.
        note: told which do not vibrate and are left out.

    Raises:
        SolveError: none vibrates.
    """
    undamped = vehicle_modes(results, below_hz)
    found: dict[int, DampedMode] = {}
    for number in undamped.numbers:
        try:
            found[number] = complex_mode(results, number - 1)
        except SolveError as error:
            note(f"{str(error).partition(': ')[0]}: it is left out")
    if not found:
        raise SolveError(f"no mode below {below_hz:g} Hz vibrates")
    eigenvalue = np.array([mode.eigenvalue for mode in found.values()])
    shapes = np.stack([mode.shape for mode in found.values()], axis=1)
    names = dict(zip(undamped.numbers, undamped.names, strict=True))
    return ShapeSet(
        tuple(names[number] for number in found),
        tuple(found),
        np.abs(eigenvalue) / (2 * np.pi),
        np.array([mode.damping_ratio for mode in found.values()]),
        0.0,
        shapes,
        undamped.dofs,
        eigenvalue,
        _modal_a(results.system, eigenvalue, shapes),
    )


def _modal_a(system: System, eigenvalue: Complexes, shapes: Complexes) -> Complexes:
    """ψᵀ(2λM + C)ψ of each, (n_modes,): that by which a force is divided, besides jω - λ."""
    mass = np.einsum("ij,ij->j", shapes, system.mass @ shapes)
    damping = np.einsum("ij,ij->j", shapes, system.damping @ shapes)
    return 2 * eigenvalue * mass + damping


def body_modes(body: FlexibleBody) -> ShapeSet:
    """Return all modes of a body alone, its residual vectors among them."""
    normal, n = body.n_normal, body.n_modes
    kinds = [(0, body.n_rigid, "rigid mode"), (body.n_rigid, normal, "mode"), (normal, n, "residual")]
    names = [
        f"{kind} {i + 1 if kind == 'mode' else i - first + 1}"
        for first, last, kind in kinds
        for i in range(first, last)
    ]
    return ShapeSet(
        tuple(names),
        tuple(range(1, n + 1)),
        body.natural_frequency_hz,
        body.damping_ratios,
        body.loss_factor,
        np.eye(n),
        {body.name: slice(0, n)},
        n_residuals=body.n_residuals,
    )
