"""What modeviz itself takes: preparation, one event, many sets of rates, memory."""

import itertools
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from benchmarks.measure import peak_bytes, turn
from benchmarks.peers import solve_directly
from benchmarks.report import SizeRow
from benchmarks.scaled_vehicle import Size, scaled_vehicle
from benchmarks.work import Work
from modeviz.analysis.batch import solve_many
from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions, drive, solve_on
from modeviz.dynamics.basis import TOP_HZ
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle

N_SETS = 10
"""Sets of rates in a batch."""

STEP, N_STEPS = 1.01, 30
"""Of a slider that is dragged, and how many."""

N_DIRECT = 2
"""Frequencies from which the direct solution's time is scaled."""


def figures(size: Size | None, n_freqs: int, top_hz: float = TOP_HZ) -> SizeRow:
    """The figures of a vehicle of some size, or of the built-in truck.

    Args:
        size: None for the truck.
        n_freqs: how many frequencies, spread over the band.
        top_hz: up to where modes are found.
    """
    vehicle = scaled_vehicle(size) if size else read_vehicle(builtin_vehicle())
    begin = time.perf_counter()
    lines = vehicle.frequency_hz
    every = len(lines) // n_freqs
    prepared = prepare(vehicle, lines[::every] if every > 1 else None, top_hz=top_hz)
    prepare_s = time.perf_counter() - begin
    work = Work(prepared, _stiffer(vehicle))
    response_ms = _median_ms(lambda: work.receptances.response(work.mount_stiffness))
    event_ms = _median_ms(_event(prepared))
    batch_ms = _median_ms(lambda: _batch(prepared))
    peak = peak_bytes()  # before the direct solution, which needs memory of its own
    direct_ms = _median_ms(lambda: solve_directly(work, slice(N_DIRECT)))
    return SizeRow(
        n_dofs=prepared.system.n_dofs,
        n_springs=len(work.mount_stiffness),
        n_frequencies=n_freqs,
        n_modes=prepared.basis.n_modes,
        prepare_s=prepare_s,
        response_ms=response_ms,
        event_ms=event_ms,
        batch_per_s=1e3 * N_SETS / batch_ms,
        peak_mb=peak / 1e6,
        numpy_direct_ms=direct_ms * n_freqs / N_DIRECT,
    )


def _median_ms(call: Callable[[], object]) -> float:
    return 1e3 * statistics.median(turn(call))


def _event(prepared: Prepared) -> Callable[[], None]:
    """A slider's next step after a rest: modes with their names, spectra, RMS values and rating."""
    vehicle = prepared.vehicle
    ride = drive(prepared.near(vehicle.rates), _conditions(vehicle))
    drags = itertools.cycle(_drags(vehicle))

    def event() -> None:
        results = solve_on(ride, next(drags))
        assert results.names
        assert results.rms.size
        assert results.rating

    return event


def _drags(vehicle: Vehicle) -> Iterator[Rates]:
    """The rates of every group in turn, dragged up in steps of a slider."""
    for name, rates in vehicle.rates.items():
        for factor in STEP ** np.arange(N_STEPS):
            moved = replace(rates, vertical=factor * rates.vertical, lateral=factor * rates.lateral)
            yield {name: moved}


def _batch(prepared: Prepared) -> None:
    """Sets of rates between a quarter of the vehicle's own and four times as much."""
    own = prepared.mount_stiffness({})
    factors = 4.0 ** np.random.default_rng(0).uniform(-1, 1, (N_SETS, len(own)))
    for _ in solve_many(prepared, factors * own, _conditions(prepared.vehicle)):
        pass


def _stiffer(vehicle: Vehicle) -> Rates:
    """Other rates in every group."""
    return {
        name: replace(rates, vertical=1.3 * rates.vertical, lateral=1.2 * rates.lateral)
        for name, rates in vehicle.rates.items()
    }


def _conditions(vehicle: Vehicle) -> Conditions:
    return Conditions(vehicle.roads[0].name, vehicle.speed)
