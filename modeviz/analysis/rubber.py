"""The complex rates of a group's mounts over frequency: those that responses use, and as measured."""

from dataclasses import dataclass

import numpy as np

from modeviz.analysis.preparation import PreparedModes
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.dynamic_rates import HydraulicRates, RateTable
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class RubberCurve:
    """Complex rates of a mount along its local x, y and z."""

    frequency_hz: Floats
    """(n_freqs,)."""
    rates: Complexes
    """(n_freqs, 3), N/m."""

    @property
    def stiffness(self) -> Floats:
        """The magnitude that a test rig tells, (n_freqs, 3), N/m."""
        return np.asarray(np.abs(self.rates), np.float64)

    @property
    def loss_angle(self) -> Floats:
        """By how much the force leads, (n_freqs, 3), rad."""
        return np.asarray(np.angle(self.rates), np.float64)


def dynamic_groups(vehicle: Vehicle) -> tuple[MountGroup, ...]:
    """The groups of mounts whose rates depend on frequency."""
    return tuple(group for group in vehicle.mount_groups if group.dynamic is not None)


def rubber_curve(
    prepared: PreparedModes, rates: Rates, group: str, frequency_hz: Floats
) -> RubberCurve:
    """What the mounts of a group have with some rates, as modes and responses take it.

    Args:
        prepared: see `prepare_modes`.
        rates: of the groups that differ from the vehicle's own.
        group: its name.
        frequency_hz: (n_freqs,).

    Raises:
        VehicleError: a group that the vehicle does not have.
    """
    springs = _springs(prepared.vehicle, group)
    law = prepared.basis.law.of(springs)
    own = law.stiffness(prepared.mount_stiffness(rates)[springs], frequency_hz)
    return RubberCurve(frequency_hz, np.broadcast_to(own, (len(frequency_hz), 3)))


def measured_points(prepared: PreparedModes, rates: Rates, group: str) -> RubberCurve | None:
    """The lines of a group's table scaled as its rates are; None of what is no table.

    Arguments and errors as of `rubber_curve`.
    """
    table = prepared.vehicle.mount_group(group).dynamic
    if not isinstance(table, RateTable):
        return None
    at_reference = table.complex_rates(np.array([table.reference_hz]))[0].real
    own = prepared.mount_stiffness(rates)[_springs(prepared.vehicle, group)].real
    return RubberCurve(table.frequency_hz, table.rates * (own / at_reference))


def about_rubber(group: MountGroup) -> str:
    """What a group's rates over frequency are made of, in a sentence."""
    match group.dynamic:
        case RateTable(amplitude=amplitude):
            at = "" if amplitude is None else f" at {1e3 * amplitude:g} mm"
            what = f"Points: its table{at}"
        case HydraulicRates():
            what = "A hydraulic mount"
        case _:
            what = "A three-parameter rubber"
    return f"{what}, scaled as its rates are."


def _springs(vehicle: Vehicle, group: str) -> np.ndarray:
    """The three springs along the axes of a group's first mount."""
    vehicle.mount_group(group)
    first = [mount.group for mount in vehicle.mounts].index(group)
    return np.arange(3 * first, 3 * first + 3)
