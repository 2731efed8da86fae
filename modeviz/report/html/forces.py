"""The report's sections on forces of mounts and on paths; empty where nothing shakes the vehicle."""

from html import escape

import numpy as np

from modeviz.analysis.line_forces import prepare_line
from modeviz.analysis.modal_results import ModalResults
from modeviz.analysis.mount_forces import MountForces, figures_of, harmonic_mount_forces
from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import AXIS, Results
from modeviz.mounting.levels import input_spectra
from modeviz.mounting.paths import Paths, solve_paths
from modeviz.report.comparison import Comparison
from modeviz.report.html.sides import by_direction
from modeviz.ride.excitation import Load
from modeviz.text.markup import note, section, table, title
from modeviz.text.wording import number
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.engine import EngineOrder
from modeviz.vehicle.loads import Road
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS

LEAST_SHOWN = 0.01
"""Share of a response, below which a path is not listed."""

DRIVER = 0
"""The response point whose paths are told."""


def forces(comparison: Comparison) -> str:
    """Return the force of every mount with both sets, along its own axes."""
    load = _load(comparison)
    mounts = comparison.vehicle.mounts
    if load is None or not mounts:
        return ""
    found = [_mount_forces(r, load) for r in (comparison.base, comparison.now)]
    base, now = (figures_of(mounts, each.vehicle, each.figures)[:, :3] for each in found)
    f = found[1].frequency_hz
    what = "RMS" if found[1].is_random else "Largest peak"
    return section(
        "Forces of mounts",
        note(
            f"{what}, N, under {escape(load.name)}, {f[0]:g} to {f[-1]:g} Hz, on the body that carries "
            "the mount: along its own axes z (vertical), y (lateral) and x (fore-aft)."
        ),
        by_direction(comparison, [mount.name for mount in mounts], base, now, 1),
    )


def paths(comparison: Comparison) -> str:
    """Return what of the driver's accelerations comes through which connection, at their peaks."""
    load = _load(comparison)
    if load is None or not comparison.vehicle.response_points:
        return ""
    point = comparison.vehicle.response_points[DRIVER]
    tables = [_paths_at_peak(comparison, load, direction) for direction in RIDE_DIRECTIONS]
    if not any(tables):
        return ""
    return section(
        f"Paths to {escape(point.name)}",
        note(
            f"Under {escape(load.name)}, {_where(comparison, load)}. The body is cut free: the share "
            "of a connection is what of the response is coherent with the part that comes through it, "
            "and all shares add up to 100 %; negative is what works against the others."
        ),
        *tables,
    )


def _where(comparison: Comparison, load: Load) -> str:
    if isinstance(load, EngineOrder):
        return "where the engine idles"
    return f"where each acceleration is highest with {escape(comparison.names[1])}"


def _paths_at_peak(comparison: Comparison, load: Load, direction: str) -> str:
    """A table of shares with both sets; nothing of a response that is none."""
    f = _peak_hz(comparison, load, direction)
    if f is None:
        return ""
    sides = [_shares(r, load, f, direction) for r in (comparison.base, comparison.now)]
    (earlier, known), (together, after) = sides
    shares = {path.connection: share for path, share in zip(earlier.paths, known, strict=True)}
    before = [shares.get(path.connection, 0.0) for path in together.paths]
    order = [i for i in np.argsort(-np.abs(after)) if max(abs(after[i]), abs(before[i])) >= LEAST_SHOWN]
    rows = [
        [title(together.paths[i].connection), *(_percent(float(s[i])) for s in (before, after))]
        for i in order
    ]
    heading = f"<h3>{direction.capitalize()}, {f:.2f} Hz</h3>"
    return heading + table(["Through", *map(escape, comparison.names)], rows)


def _percent(share: float) -> str:
    return f"{number(100 * share, 1)} %"


def _shares(
    results: ModalResults, load: Load, frequency_hz: float, direction: str
) -> tuple[Paths, Floats]:
    """The paths to the driver by connection, and their shares, (n_paths,)."""
    prepared, speed = results.prepared, _speed(results)
    system, point = prepared.system, prepared.vehicle.response_points[DRIVER]
    line = prepare_line(prepared, results.rates, load, frequency_hz, speed)
    reading = system.motion(point.body, point.position)[AXIS[direction]]
    solved = line.forces(prepared.mount_stiffness(results.rates))
    together = solve_paths(solved, point.body, reading[system.dofs[point.body]]).together("mount")
    return together, together.shares(input_spectra(load, np.array([frequency_hz]), speed))[0]


def _peak_hz(comparison: Comparison, load: Load, direction: str) -> float | None:
    """Where the driver's acceleration is highest with the second set; None where there is none.

    Under an order of an engine where that idles.
    """
    if isinstance(load, EngineOrder):
        idle_hz = load.order * comparison.vehicle.engine(load.engine).idle_hz
        return idle_hz if idle_hz <= comparison.vehicle.highest_frequency else None
    if comparison.rides is not None:
        now = comparison.rides[1]
        f, level = now.frequency_hz, now.response(DRIVER, direction)
    elif comparison.wheels is not None:
        wheels = comparison.wheels[1]
        number_of_load = [each.name for each in comparison.vehicle.harmonic_loads].index(load.name)
        f = wheels.frequency_hz
        level = wheels.acceleration_g[:, number_of_load, DRIVER, AXIS[direction]]
    else:
        return None
    return float(f[int(np.argmax(level))]) if level.any() else None


def _load(comparison: Comparison) -> Load | None:
    """What shakes: the road, else the first harmonic load or order of an engine, if there is one."""
    if comparison.rides is not None:
        return comparison.rides[1].drive.load
    return next(iter(comparison.vehicle.swept_loads), None)


def _mount_forces(results: ModalResults, load: Load) -> MountForces:
    if isinstance(results, Results):
        return results.mount_forces()
    assert isinstance(results.prepared, Prepared)
    assert not isinstance(load, Road)
    return harmonic_mount_forces(results.prepared, results.rates, load, _speed(results))


def _speed(results: ModalResults) -> float:
    return results.conditions.speed if isinstance(results, Results) else results.vehicle.speed
