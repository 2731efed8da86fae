"""Forces of connections as a table for a terminal and as plain values."""

import numpy as np

from modeviz.analysis.forces import LoadedForces
from modeviz.report.records import Record, rates_record
from modeviz.report.tables import table
from modeviz.text.wording import number
from modeviz.vehicle.connections import MOTIONS, Mount

LEAST_SHOWN = 0.005
"""Part of all that is dissipated, below which a place is not listed."""

LEAST_RATIO = 1e-9
"""Transmissibility below which an end stands still."""

ALONG, ABOUT = MOTIONS[:3], MOTIONS[3:]


def listed(found: LoadedForces, every: bool) -> list[int]:
    """The numbers of the connections that are told of: mounts, or all that act."""
    connections = found.forces.connections
    return [i for i, c in enumerate(connections) if (every or isinstance(c, Mount)) and found.acting(i)]


def forces_record(found: LoadedForces, every: bool = False) -> Record:
    """The forces of mounts, or of all connections, under a load.

    `{"vehicle", "rates": see rates_record, "load", "is_random", "speed_m_per_s", "frequency_hz": [...],
    "connections": [{"name", "kind", "group", "bodies": [carried, carrying], "axes": [[3 numbers] 3
    times], "local_axes": {"x" ... "rz": figures}, "vehicle_axes": likewise, "transmissibility":
    {"x", "y", "z": {"ratio": [...], "overall"}}}], "force_transmissibility": [...] or null, "work":
    [...], "dissipated": {connection or body: [...]}, "dissipated_w": {connection or body: number}}`.

    Figures of a random load are `{"rms", "psd": [...]}`, of a harmonic one `{"amplitude": [...],
    "phase_deg": [...]}`, in N, about axes N m; phases are to the load's. Forces are those on the
    carrying body, the second. Work and what is dissipated are spectra of power, W/Hz, or mean powers,
    W; `dissipated_w` is empty under a harmonic load.
    """
    lost, through = found.dissipation, found.force_transmissibility
    return {
        "vehicle": found.vehicle.name,
        "rates": rates_record(found.vehicle),
        "load": found.load.name,
        "is_random": found.is_random,
        "speed_m_per_s": found.speed,
        "frequency_hz": found.frequency_hz.tolist(),
        "connections": [_connection_record(found, i) for i in listed(found, every)],
        "force_transmissibility": None if through is None else through.tolist(),
        "work": lost.work.tolist(),
        "dissipated": {name: power.tolist() for name, power in lost.by_place.items()},
        "dissipated_w": dict(lost.power),
    }


def _connection_record(found: LoadedForces, i: int) -> Record:
    connection = found.forces.connections[i]
    ratio, overall = found.transmissibility(i)
    return {
        "name": connection.name,
        "kind": type(connection).__name__.lower(),
        "group": connection.group,
        "bodies": list(connection.bodies),
        "axes": connection.axes.tolist(),
        "local_axes": {m: _figures(found, i, m, False) for m in found.acting(i)},
        "vehicle_axes": {m: _figures(found, i, m, True) for m in found.acting(i, True)},
        "transmissibility": {
            m: {"ratio": ratio[:, n].tolist(), "overall": float(overall[n])}
            for n, m in enumerate(ALONG)
        },
    }


def _figures(found: LoadedForces, i: int, motion: str, in_vehicle_axes: bool) -> Record:
    force = found.force(i, motion, in_vehicle_axes)
    if found.is_random:
        rms = found.rms[int(in_vehicle_axes), i, MOTIONS.index(motion)]
        return {"rms": float(rms), "psd": found.spectra.psd(force)[:, 0].tolist()}
    phasor = force[:, 0, 0]
    return {"amplitude": np.abs(phasor).tolist(), "phase_deg": np.degrees(np.angle(phasor)).tolist()}


def forces_table(found: LoadedForces, every: bool = False) -> str:
    """The force of each mount, or of each connection, what gets through it and what it turns to heat.

    Under a random load RMS, at a single frequency the root of the PSD; under a harmonic load the
    largest amplitude and where that is, at a single frequency amplitude and phase.
    """
    numbers = listed(found, every)
    if not numbers:
        return "no mount passes a force on"
    parts = [_forces(found, numbers, ALONG, "force", "N")]
    if any(set(found.acting(i)) & set(ABOUT) for i in numbers):
        parts.append(_forces(found, numbers, ABOUT, "moment", "N m"))
    parts += [_transmissibility(found, numbers), _heat(found)]
    return "\n\n".join(part for part in parts if part)


def _forces(
    found: LoadedForces, numbers: list[int], motions: tuple[str, ...], what: str, unit: str
) -> str:
    """Forces or moments along or about the local and the vehicle's axes."""
    rows = [
        [
            found.forces.connections[i].name,
            *(_cell(found, i, motion, False) for motion in motions),
            *(_cell(found, i, motion, True) for motion in motions),
        ]
        for i in numbers
        if set(found.acting(i, True)) & set(motions)
    ]
    heading = f"{_level(found, what, unit)}, {found.load.name}, {band(found)}"
    local = [f"local {motion}" for motion in motions]
    return table([heading, *local, *(f"vehicle {motion}" for motion in motions)], rows)


def _level(found: LoadedForces, what: str, unit: str) -> str:
    """What of a force is told, with its unit."""
    if found.is_random:
        return f"RMS {what}, {unit}" if _has_band(found) else f"{what}, {unit}/√Hz"
    return f"peak {what}, {unit}" + (", where largest" if _has_band(found) else ", phase to the load")


def band(found: LoadedForces) -> str:
    """Where forces were solved for, "0.1 to 40 Hz"."""
    first, last = found.frequency_hz[[0, -1]]
    return f"{first:g} to {last:g} Hz" if _has_band(found) else f"{first:g} Hz"


def _has_band(found: LoadedForces) -> bool:
    return len(found.frequency_hz) > 1


def _cell(found: LoadedForces, i: int, motion: str, in_vehicle_axes: bool) -> str:
    if motion not in found.acting(i, in_vehicle_axes):
        return "-"
    force = found.force(i, motion, in_vehicle_axes)
    if found.is_random:
        rms = found.rms[int(in_vehicle_axes), i, MOTIONS.index(motion)]
        return f"{rms:.4g}" if _has_band(found) else f"{found.spectra.psd(force)[0, 0] ** 0.5:.4g}"
    phasor = force[:, 0, 0]
    largest = int(np.abs(phasor).argmax())
    amplitude = f"{np.abs(phasor[largest]):.4g}"
    if _has_band(found):
        return f"{amplitude} ({found.frequency_hz[largest]:.1f} Hz)"
    return f"{amplitude} ({number(float(np.degrees(np.angle(phasor[0]))), 0)}°)"


def _transmissibility(found: LoadedForces, numbers: list[int]) -> str:
    """Accelerations of the carrying ends over those of the carried ones, and what a force passes on.

    A carrying end that stands still, as the ground does under loads of its own, is left out.
    """
    rows = []
    for i in numbers:
        connection = found.forces.connections[i]
        ratio, overall = found.transmissibility(i)
        told = overall if _has_band(found) else ratio[0]
        if told.max() < LEAST_RATIO:
            continue
        ends = " / ".join(reversed(connection.bodies))
        rows.append([connection.name, ends, *(f"{value:.3g}" for value in told)])
    what = "root mean square" if _has_band(found) else "acceleration"
    ratios = table([f"transmissibility: {what}", "of / over", *ALONG], rows) if rows else ""
    through = found.force_transmissibility
    if through is None:
        return ratios
    largest = int(through.argmax())
    words = f"{through[largest]:.3g} of the force is passed on at {found.frequency_hz[largest]:.4g} Hz"
    words += ", where that is most" if _has_band(found) else ""
    return f"{ratios}\n\n{words}" if ratios else words


def _heat(found: LoadedForces) -> str:
    """Where energy is turned into heat, the most first."""
    lost = found.dissipation
    if found.is_random and _has_band(found):
        power = dict(lost.power)
        heading = "dissipated, W"
    else:
        at = int(lost.work.argmax())
        power = {name: float(each[at]) for name, each in lost.by_place.items()}
        unit = "W/Hz" if found.is_random else "W"
        heading = f"dissipated at {found.frequency_hz[at]:.4g} Hz, {unit}"
    total = sum(power.values())
    names = sorted(power, key=lambda name: -power[name])
    shown = [name for name in names if power[name] >= LEAST_SHOWN * total]
    rows = [[n, f"{power[n]:.3g}", f"{100 * power[n] / total:.1f} %"] for n in shown if total]
    return table([heading, "", "share"], [*rows, ["all", f"{total:.3g}", ""]])
