"""Results as plain values for JSON; the structure is documented here and stays stable."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np

from modeviz.analysis.modal_results import ModalResults
from modeviz.analysis.mode_tracking import Followed
from modeviz.analysis.results import AXIS, Results
from modeviz.analysis.wheel_results import WheelResults
from modeviz.report.components import component_record
from modeviz.report.rate_fields import quantity
from modeviz.ride.psd import amplitude_decibels
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.engine import EngineOrder
from modeviz.vehicle.loads import BaseMotion, Force, HarmonicLoad, WheelLoad
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import RATE_FIELDS, spoken_value
from modeviz.vehicle.vehicle import Vehicle

Record = dict[str, Any]


def rates_record(vehicle: Vehicle) -> Record:
    """`{group: {"vertical", "lateral", "fore_aft", "loss_factor"}}`, rates in N/mm.

    Where they are tuned, rates about the local axes, "rx", "ry" and "rz", N m/rad, and of dampers,
    "damping_vertical", "damping_lateral" and "damping_fore_aft", N s/m, stand there too.
    """
    return {group.name: _group_record(group) for group in vehicle.mount_groups}


def _group_record(group: MountGroup) -> Record:
    told = (f for f in RATE_FIELDS if quantity(f) == "stiffness" or f in group.fields)
    rates = {field: spoken_value(group.rates, field) for field in told}
    return {**rates, "loss_factor": group.loss_factor}


def modes_record(followed: Followed, below_hz: float) -> Record:
    """The modes below a frequency, and where those with the vehicle's own rates went.

    `{"vehicle", "rates": see rates_record, "n_missed", "modes": [{"number", "frequency_hz",
    "frequency_error_hz", "damping_ratio", "name", "name_score", "kinetic_energy": {body: share},
    "strain_energy": {body or connection group: share}, "dissipated_energy": likewise}], "original":
    [{"number", "frequency_hz", "name", "now": number or null, "mac", "weak", "parts": [{"number",
    "share"}]}], "components": [the fields of dynamics.component_trust.ComponentTrust]}`.
    """
    results = followed.now
    return {
        "vehicle": results.vehicle.name,
        "rates": rates_record(results.vehicle),
        "n_missed": results.trust.n_missed,
        "modes": [_mode_record(results, i) for i in _below(results, below_hz)],
        "original": [_origin_record(followed, i) for i in _below(followed.base, below_hz)],
        "components": [component_record(trust) for trust in results.components],
    }


def _below(results: ModalResults, below_hz: float) -> list[int]:
    return np.flatnonzero(results.modes.frequency_hz < below_hz).tolist()


def _mode_record(results: ModalResults, i: int) -> Record:
    return {
        "number": i + 1,
        "frequency_hz": float(results.modes.frequency_hz[i]),
        "frequency_error_hz": float(results.trust.frequency_error_hz[i]),
        "damping_ratio": float(results.modes.damping_ratio[i]),
        "name": results.names[i].name,
        "name_score": results.names[i].score,
        "kinetic_energy": _shares(results.kinetic_energy, i),
        "strain_energy": _shares(results.strain_energy, i),
        "dissipated_energy": _shares(results.dissipated_energy, i),
    }


def _origin_record(followed: Followed, i: int) -> Record:
    base, track = followed.base, followed.track
    return {
        "number": i + 1,
        "frequency_hz": float(base.modes.frequency_hz[i]),
        "name": base.names[i].name,
        "now": int(track.index[i]) + 1 if track.index[i] >= 0 else None,
        "mac": float(track.mac[i]),
        "weak": bool(track.weak[i]),
        "parts": [{"number": n + 1, "share": share} for n, share in track.split(i)],
    }


def psd_record(results: Results) -> Record:
    """Accelerations on a road, or under another random load, whose name is then the road's.

    `{"vehicle", "rates", "road", "speed_m_per_s", "band_hz": [first, last], "known_hz": [first, last],
    "frequency_hz": [...], "responses": [{"point", "direction", "psd_g2_per_hz": [...], "rms_g"}],
    "rating": the fields of ride.rating.Rating}`; of the vehicle's band only what the road's table holds
    is known, and what the rest would add is unknown; lines lie closer where a mode is sharp.
    """
    responses = [
        {
            "point": point.name,
            "direction": direction,
            "psd_g2_per_hz": results.response(i, direction).tolist(),
            "rms_g": float(results.rms[i, axis]),
        }
        for i, point in enumerate(results.vehicle.response_points)
        for direction, axis in AXIS.items()
    ]
    return {
        "vehicle": results.vehicle.name,
        "rates": rates_record(results.vehicle),
        "road": results.conditions.road,
        "speed_m_per_s": results.conditions.speed,
        "band_hz": results.prepared.frequency_hz[[0, -1]].tolist(),
        "known_hz": list(results.drive.known),
        "frequency_hz": results.frequency_hz.tolist(),
        "responses": responses,
        "rating": asdict(results.rating),
    }


def wheels_record(vehicle: Vehicle, results: WheelResults) -> Record:
    """Response to each wheel load and other harmonic load.

    `{"vehicle", "rates", "frequency_hz": [...], "loads": [{"load", "kind", "tyre" or null, "amplitude",
    "responses": [{"point", "direction", "acceleration_g": [...peak], "acceleration_db": [...re 1 g]}]
    }]}`; the amplitude is in N, of an unbalance in kg m, of a base motion in m or m/s²; that of an
    engine's order depends on its speed: null.
    """
    loads = [
        {**_load_record(load), "responses": _wheel_responses(vehicle, results, i)}
        for i, load in enumerate(vehicle.harmonic_loads)
    ]
    return {
        "vehicle": vehicle.name,
        "rates": rates_record(vehicle),
        "frequency_hz": results.frequency_hz.tolist(),
        "loads": loads,
    }


def _load_record(load: HarmonicLoad) -> Record:
    match load:
        case WheelLoad():
            kind, tyre = load.kind, load.tyre
        case Force():
            kind, tyre = "force", None
        case BaseMotion():
            kind, tyre = f"base {load.quantity}", None
        case EngineOrder():
            return {"load": load.name, "kind": "engine order", "tyre": None, "amplitude": None}
    return {"load": load.name, "kind": kind, "tyre": tyre, "amplitude": load.amplitude}


def _wheel_responses(vehicle: Vehicle, results: WheelResults, load: int) -> list[Record]:
    g = results.acceleration_g[:, load]
    decibels = amplitude_decibels(g)
    return [
        {
            "point": point.name,
            "direction": direction,
            "acceleration_g": g[:, i, axis].tolist(),
            "acceleration_db": decibels[:, i, axis].tolist(),
        }
        for i, point in enumerate(vehicle.response_points)
        for direction, axis in AXIS.items()
    ]


def _shares(energy: Mapping[str, Floats], mode: int) -> dict[str, float]:
    return {name: float(share[mode]) for name, share in energy.items()}
