"""Names for modes, from what moves.

Each named motion gives every mode a score from 0 to 1, the share of the motion in the mode; one
assignment, solved as a whole, hands the names out. What is left is called after the bodies that move
most and how they do. Nothing here knows a particular vehicle: bodies enter by their role.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from modeviz.dynamics.assembly import System
from modeviz.dynamics.energy import kinetic_energy
from modeviz.dynamics.modes import Modes
from modeviz.dynamics.motions import (
    ends_vertical,
    energy_share,
    frame_flexibility,
    rigid_share,
    wheel_motions,
)
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body, FlexibleBody, Role
from modeviz.vehicle.vehicle import Vehicle

MINIMUM_SCORE = 0.3
"""Below this a mode is not called by a named motion."""

RIDE_SHARE = 0.7
"""A mode with more than this in the rigid motion of the whole vehicle is a ride mode."""

MOTION_WORDS = ("fore-aft", "lateral", "bounce", "roll", "pitch", "yaw")


@dataclass(frozen=True)
class ModeName:
    """What a mode is called, and how well that fits."""

    name: str
    score: float
    """Share of that motion in the mode, 0 to 1."""


@dataclass(frozen=True, eq=False)
class Unit:
    """Bodies that are spoken of together: the cab with its front end, an axle's wheels."""

    word: str
    bodies: tuple[Body, ...]


def name_modes(system: System, modes: Modes) -> tuple[ModeName, ...]:
    """A name for each mode, no name twice."""
    catalogue = named_motions(system, modes)
    names = list(catalogue)
    scores = np.array([catalogue[n] for n in names]).reshape(len(names), len(modes.frequency_hz))
    rows, columns = linear_sum_assignment(-scores)
    given = {
        int(mode): ModeName(names[row], float(scores[row, mode]))
        for row, mode in zip(rows, columns, strict=True)
        if scores[row, mode] >= MINIMUM_SCORE
    }
    described = _describe(system, modes)
    return _without_repeats(given.get(i, described[i]) for i in range(len(described)))


def named_motions(system: System, modes: Modes) -> dict[str, Floats]:
    """The score (n_modes,) of every mode in each named motion the vehicle can have."""
    whole = rigid_share(system, system.vehicle.bodies, modes.shapes)
    ride = whole.sum(axis=0) > RIDE_SHARE
    scores = {n: s * ride for n, s in _ride_motions(system, modes, whole).items()}
    for motions in (_wheel_scores, _frame_scores, _body_scores):
        scores |= {n: s * ~ride for n, s in motions(system, modes).items()}
    return scores


def _ride_motions(system: System, modes: Modes, whole: Floats) -> dict[str, Floats]:
    """The vehicle as one body on its suspension.

    Bounce is heave and pitch about a far point, at the end that moves; pitch also goes fore and aft.
    """
    axles = _axles(system.vehicle)
    if len(axles) < 2:
        return {}
    fore_aft, lateral, heave, roll, pitch, _ = whole
    front, rear = ends_vertical(system, (axles[0][0], axles[-1][0]), modes.shapes) ** 2
    moves = front + rear > 0
    at_front = np.where(moves, front / np.where(moves, front + rear, 1.0), 0.5)
    return {
        "roll": lateral + roll,
        "front bounce": (heave + pitch) * at_front,
        "rear bounce": (heave + pitch) * (1 - at_front),
        "pitch": fore_aft + pitch,
    }


def _wheel_scores(system: System, modes: Modes) -> dict[str, Floats]:
    """Wheels against their tyres: in phase, they hop; in antiphase, they tramp."""
    scores = {}
    for word, (_, wheels) in zip(_axle_words(system.vehicle), _axles(system.vehicle), strict=True):
        hop, tramp = energy_share(system, wheel_motions(system, wheels), modes.shapes)
        scores |= {f"{word} hop": hop, f"{word} tramp": tramp}
    return scores


def _frame_scores(system: System, modes: Modes) -> dict[str, Floats]:
    for body in system.vehicle.bodies:
        if isinstance(body, FlexibleBody) and body.role == "frame":
            beaming, torsion = frame_flexibility(system, body, modes)
            return {"first torsion": torsion, "first beaming": beaming}
    return {}


def _body_scores(system: System, modes: Modes) -> dict[str, Floats]:
    """Cabin and powertrain on their mounts, and the two of them together."""
    scores: dict[str, Floats] = {}
    cab_moves = engine_moves = np.zeros(len(modes.frequency_hz))
    if cabin := unit_of_role(system.vehicle, "cabin"):
        _, _, heave, _, pitch, yaw = rigid_share(system, cabin.bodies, modes.shapes)
        scores[f"{cabin.word} yaw"] = yaw
        cab_moves = heave + pitch
    if powertrain := unit_of_role(system.vehicle, "powertrain"):
        _, _, heave, roll, pitch, _ = rigid_share(system, powertrain.bodies, modes.shapes)
        scores |= {f"{powertrain.word} pitch": pitch, f"{powertrain.word} roll": roll}
        engine_moves = pitch + heave / 2
    if cabin and powertrain:
        both = np.minimum(2 * np.sqrt(engine_moves * cab_moves), 1.0)
        scores[f"{powertrain.word} pitch and {cabin.word} bounce"] = both
    return scores


def _describe(system: System, modes: Modes) -> list[ModeName]:
    """Each mode after the unit with most kinetic energy and the largest of its rigid motions."""
    units = _units(system.vehicle)
    energy = kinetic_energy(system, modes.shapes)
    unit_energy = np.array([sum(energy[b.name] for b in unit.bodies) for unit in units])
    motions = np.array([_unit_motions(system, unit, modes.shapes) for unit in units])
    whole = rigid_share(system, system.vehicle.bodies, modes.shapes)
    names = []
    for i in range(modes.shapes.shape[1]):
        if whole[:, i].sum() > RIDE_SHARE:
            names.append(_motion_name("vehicle", whole[:, i], 1.0))
        else:
            most = int(unit_energy[:, i].argmax())
            names.append(_motion_name(units[most].word, motions[most, :, i], unit_energy[most, i]))
    return names


def _motion_name(word: str, rigid: Floats, energy: float) -> ModeName:
    """Called "engine yaw", or "box flexing" where less than half of the unit's energy is rigid."""
    if rigid.sum() < energy / 2:
        return ModeName(f"{word} flexing", float(energy))
    return ModeName(f"{word} {MOTION_WORDS[int(rigid.argmax())]}", float(rigid.max()))


def _unit_motions(system: System, unit: Unit, shapes: Floats) -> Floats:
    """Rigid shares (6, n_modes) of the unit as one, or of an axle's wheels about their own centres."""
    if unit.bodies[0].role == "unsprung":
        return sum(
            (rigid_share(system, [b], shapes) for b in unit.bodies), np.zeros((6, shapes.shape[1]))
        )
    return rigid_share(system, unit.bodies, shapes)


def _axles(vehicle: Vehicle) -> list[tuple[float, list[Body]]]:
    """Each axle's station x and the bodies that carry its tyres, front to rear."""
    axles: dict[float, list[Body]] = {}
    for tyre in sorted(vehicle.tyres, key=lambda t: t.wheel_center[0]):
        station = next((x for x in axles if abs(x - tyre.wheel_center[0]) < 0.3), tyre.wheel_center[0])
        carriers = axles.setdefault(float(station), [])
        carrier = vehicle.body(tyre.bodies[0])
        if carrier not in carriers:
            carriers.append(carrier)
    return list(axles.items())


def _axle_words(vehicle: Vehicle) -> list[str]:
    n = len(_axles(vehicle))
    return ["front", *(f"axle {i}" for i in range(2, n)), "rear"][:n] if n > 1 else ["wheel"] * n


def unit_of_role(vehicle: Vehicle, role: Role) -> Unit | None:
    """The bodies of a role as one unit, called after the one with most modes or mass."""
    bodies = tuple(b for b in vehicle.bodies if b.role == role)
    if not bodies:
        return None
    return Unit(max(bodies, key=_mass).label, bodies)


def _mass(body: Body) -> float:
    """Mass in kg; a flexible body's follows from its rigid modes."""
    if not isinstance(body, FlexibleBody):
        return body.mass
    to_modes = np.linalg.inv(body.attachments[0].shapes[:, : body.N_RIGID])
    return float(to_modes[:, 0] @ to_modes[:, 0])


def _units(vehicle: Vehicle) -> list[Unit]:
    """Every body in one unit: roles that move as one, axles, and the rest by themselves."""
    together: tuple[Role, ...] = ("cabin", "frame", "bed", "powertrain")
    units = [unit for role in together if (unit := unit_of_role(vehicle, role))]
    for word, (_, wheels) in zip(_axle_words(vehicle), _axles(vehicle), strict=True):
        label = wheels[0].label if len(wheels) == 1 else f"{word} wheels"
        units.append(Unit(label, tuple(wheels)))
    taken = {b.name for unit in units for b in unit.bodies}
    return units + [Unit(b.label, (b,)) for b in vehicle.bodies if b.name not in taken]


def _without_repeats(names: Iterable[ModeName]) -> tuple[ModeName, ...]:
    """The same names, a second "box flexing" called "box flexing 2"."""
    counts: dict[str, int] = {}
    result = []
    for name in names:
        counts[name.name] = n = counts.get(name.name, 0) + 1
        result.append(name if n == 1 else ModeName(f"{name.name} {n}", name.score))
    return tuple(result)
