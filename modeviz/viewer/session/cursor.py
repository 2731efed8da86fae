"""All forces at the frequency of the cursor: prepared once there, then by reanalysis at any rates."""

from modeviz.analysis.latest import Latest
from modeviz.analysis.line_forces import LineForces, prepare_line
from modeviz.analysis.results import Results
from modeviz.mounting.forces import Forces
from modeviz.mounting.levels import InputSpectra, input_spectra
from modeviz.ride.excitation import Load
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.state import State


class CursorForces:
    """Solves forces where the cursor is, under what excites the charts."""

    def __init__(self) -> None:
        """Solves nothing."""
        self._line: Latest[LineForces] = Latest()

    def solve(self, state: State, results: Results) -> tuple[Forces, InputSpectra, Load]:
        """Return all forces, the spectra of the load's inputs, and the load.

        Args:
            state: where the cursor is, and what excites.
            results: with whose rates.

        Raises:
            ModevizError: the load is not known there, or an undamped resonance lies there.
        """
        load, speed, f = shaking(state, results), results.conditions.speed, state.charts.cursor_hz
        prepared = results.prepared

        def prepare() -> LineForces:
            return prepare_line(prepared, results.rates, load, f, speed)

        line = self._line.get((prepared, load, speed, f), prepare)
        forces = line.forces(prepared.mount_stiffness(results.rates))
        return forces, input_spectra(load, forces.frequency_hz, speed), load


def is_shaken(vehicle: Vehicle) -> bool:
    """Return whether anything shakes a vehicle that is shown: an even road does not.

    One that has tyres and no road is driven over one of ISO 8608.
    """
    if not vehicle.roads and vehicle.has_driven_tyres:
        return True
    others = len(vehicle.random_loads) > len(vehicle.roads)
    return bool(vehicle.swept_loads) or others or not all(road.is_even for road in vehicle.roads)


def has_ride(vehicle: Vehicle) -> bool:
    """Return whether somebody feels a vehicle that is shown on a road: an even road is not felt."""
    return bool(vehicle.response_points) and not any(road.is_even for road in vehicle.roads)


def shaking(state: State, results: Results) -> Load:
    """Return the load that the charts show the response to."""
    if state.charts.load:
        return results.prepared.vehicle.harmonic_load(state.charts.load)
    return results.drive.load
