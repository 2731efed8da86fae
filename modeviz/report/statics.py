"""Sag, static forces and travel as text tables and as plain values."""

from collections.abc import Iterable, Sequence

import numpy as np

from modeviz.mounting.statics import Carried, StaticCase, Statics
from modeviz.mounting.travel import Travel, travels
from modeviz.report.records import Record, rates_record
from modeviz.report.tables import table
from modeviz.text.wording import number
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Mount

AXES = ("x", "y", "z")


def statics_record(statics: Statics) -> Record:
    """Every load case, in m, rad, N and N m.

    `{"vehicle", "rates": see rates_record, "cases": [{"name", "notes": [sentences], "bodies": {name:
    [x, y, z, rx, ry, rz]}, "mounts": {name: {"force": [x, y, z], "deflection", "moment", "rotation",
    "vehicle_force"}}, "connections": the same of all others, "travel": [{"mount", "direction",
    "deflection", "least", "most", "margin", "passed"}]}], "refused": [{"name", "reason"}]}`; forces
    are those on the first body of a mount, deflections how far that has gone from the second, along the
    mount's axes; "vehicle_force" is along the vehicle's.
    """
    return {
        "vehicle": statics.vehicle.name,
        "rates": rates_record(statics.vehicle),
        "cases": [_case_record(statics, case) for case in statics.cases],
        "refused": [{"name": refused.name, "reason": refused.reason} for refused in statics.refused],
    }


def _case_record(statics: Statics, case: StaticCase) -> Record:
    return {
        "name": case.name,
        "notes": list(case.notes),
        "bodies": {name: motion.tolist() for name, motion in case.bodies.items()},
        "mounts": {c.connection.name: _carried_record(c) for c in mounts_of(case)},
        "connections": {c.connection.name: _carried_record(c) for c in others_of(case)},
        "travel": [_travel_record(travel) for travel in travels(statics, case)],
    }


def _carried_record(carried: Carried) -> Record:
    return {
        "force": carried.force[:3].tolist(),
        "deflection": carried.deflection[:3].tolist(),
        "moment": carried.force[3:].tolist(),
        "rotation": carried.deflection[3:].tolist(),
        "vehicle_force": carried.vehicle_force[:3].tolist(),
    }


def _travel_record(travel: Travel) -> Record:
    return {
        "mount": travel.mount,
        "direction": travel.direction,
        "deflection": travel.deflection,
        "least": travel.least,
        "most": travel.most,
        "margin": travel.margin,
        "passed": travel.passed,
    }


def statics_table(statics: Statics) -> str:
    """Motions of bodies, forces, deflections and travel of connections, case by case."""
    cases = [_case_text(statics, case) for case in statics.cases]
    refused = [f"{refused.name}: no answer, {refused.reason}" for refused in statics.refused]
    return "\n\n".join([*cases, *refused])


def mounts_of(case: StaticCase) -> list[Carried]:
    """Return what the mounts of a vehicle do in a case."""
    return [c for c in case.connections.values() if isinstance(c.connection, Mount)]


def others_of(case: StaticCase) -> list[Carried]:
    """Return what all other connections do that carry loads at rest: dampers do not."""
    rest = (c for c in case.connections.values() if not isinstance(c.connection, Mount))
    return [c for c in rest if _resists(c)]


def _resists(carried: Carried) -> bool:
    connection = carried.connection
    rates = (*connection.stiffness, *connection.rotational_stiffness)
    return bool(connection.rigid) or any(rates)


def _case_text(statics: Statics, case: StaticCase) -> str:
    header = [f"{case.name}: motion", "x mm", "y mm", "z mm", "rx °", "ry °", "rz °"]
    motions = table(header, [[name, *motion_cells(motion)] for name, motion in case.bodies.items()])
    parts = [motions, *case.notes]
    for what, every in (("mount", mounts_of(case)), ("other connection", others_of(case))):
        if every:
            parts.append(_carried_table(what, every))
    limited = list(travels(statics, case))
    if limited:
        parts.append(_travel_table(limited))
    return "\n\n".join(parts)


def _carried_table(what: str, every: Sequence[Carried]) -> str:
    header = [what, *(f"{axis} N" for axis in AXES), *(f"{axis} mm" for axis in AXES)]
    return table(header, [[c.connection.name, *carried_cells(c)] for c in every])


def _travel_table(limited: Iterable[Travel]) -> str:
    rows = [[f"{t.mount} {t.direction}", *travel_cells(t)] for t in limited]
    return table(["travel", "mm", "from", "to", "margin mm", ""], rows)


def motion_cells(motion: Floats) -> list[str]:
    """Return x, y, z in mm and rx, ry, rz in degrees as they are written."""
    millimetres, degrees = 1e3 * motion[:3], np.degrees(motion[3:])
    return [number(float(v), 3) for v in (*millimetres, *degrees)]


def carried_cells(carried: Carried) -> list[str]:
    """Return a force in N and a deflection in mm as they are written, along the local axes."""
    forces = [number(float(v), 1) for v in carried.force[:3]]
    return [*forces, *(number(float(v), 3) for v in 1e3 * carried.deflection[:3])]


def travel_cells(travel: Travel) -> list[str]:
    """Return a deflection, its limits and the margin in mm, and whether it passes."""
    values = (travel.deflection, travel.least, travel.most, travel.margin)
    return [*(number(1e3 * v, 3) for v in values), "passed" if travel.passed else "failed"]
