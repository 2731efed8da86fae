"""The catalogue of named motions: how much of each is in a mode."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeviz.dynamics.roles import Axle, Unit
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Role

MOTION_WORDS = ("fore-aft", "lateral", "bounce", "roll", "pitch", "yaw")

RIDE_SHARE = 0.7
"""A mode with more than this in the rigid motion of the whole vehicle is a ride mode."""


@dataclass(frozen=True, eq=False)
class Shares:
    """The shares of modes in a vehicle's motions: parts of kinetic energy, 0 to 1, but for the ends."""

    axles: tuple[Axle, ...]
    units: tuple[Unit, ...]
    whole: Floats
    """(6, n_modes): x, y, z, rx, ry, rz of the whole vehicle as one body."""
    ends: Floats
    """(2, n_modes): its height at the first and the last axle; none with fewer than two."""
    wheels: Floats
    """(n_axles, 2, n_modes): an axle's wheels up in phase, and in antiphase."""
    bending: Floats
    """(2, n_modes): a frame's torsion and beaming, see `flexibility_share`; none without a frame."""
    rigid: Floats
    """(n_units, 6, n_modes): x, y, z, rx, ry, rz of each unit as one body."""
    energy: Floats
    """(n_units, n_modes): all that each unit has."""

    @cached_property
    def ride(self) -> np.ndarray:
        """A mask of the ride modes, (n_modes,); a vehicle that is one unit is called after that."""
        return (self.whole.sum(axis=0) > RIDE_SHARE) & (not self.is_one)

    @property
    def is_one(self) -> bool:
        """Whether the vehicle is a single unit, such as an engine on its mounts, but for absorbers."""
        return len(self.carriers) == 1 and not self.axles

    @property
    def carriers(self) -> list[int]:
        """The numbers of the units that are no absorbers."""
        return [i for i, unit in enumerate(self.units) if unit.bodies[0].role != "absorber"]

    def of_role(self, role: Role) -> tuple[str, Floats] | None:
        """The word for the unit of a role and its rigid shares, (6, n_modes); None if there is none."""
        found = (i for i, unit in enumerate(self.units) if unit.bodies[0].role == role)
        i = next(found, None)
        return None if i is None else (self.units[i].word, self.rigid[i])


def named_motions(shares: Shares) -> dict[str, Floats]:
    """The score (n_modes,) of every mode in each named motion the vehicle can have."""
    if shares.is_one:
        (only,) = shares.carriers
        words = (f"{shares.units[only].word} {motion}" for motion in MOTION_WORDS)
        motions = dict(zip(words, shares.rigid[only], strict=True))
        return {**motions, **_frame_motions(shares)}
    scores = {name: s * shares.ride for name, s in _ride_motions(shares).items()}
    for motions in (_wheel_motions, _frame_motions, _body_motions):
        scores |= {name: s * ~shares.ride for name, s in motions(shares).items()}
    return scores


def _ride_motions(shares: Shares) -> dict[str, Floats]:
    """The vehicle as one body on its suspension.

    Bounce is heave and pitch about a far point, at the end that moves; pitch also goes fore and aft.
    """
    if len(shares.axles) < 2:
        return {}
    fore_aft, lateral, heave, roll, pitch, _ = shares.whole
    front, rear = shares.ends**2
    moves = front + rear > 0
    at_front = np.where(moves, front / np.where(moves, front + rear, 1.0), 0.5)
    return {
        "roll": lateral + roll,
        "front bounce": (heave + pitch) * at_front,
        "rear bounce": (heave + pitch) * (1 - at_front),
        "pitch": fore_aft + pitch,
    }


def _wheel_motions(shares: Shares) -> dict[str, Floats]:
    """Wheels against their tyres: in phase, they hop; in antiphase, they tramp."""
    scores = {}
    for axle, (hop, tramp) in zip(shares.axles, shares.wheels, strict=True):
        scores |= {f"{axle.word} hop": hop, f"{axle.word} tramp": tramp}
    return scores


def _frame_motions(shares: Shares) -> dict[str, Floats]:
    return dict(zip(("first torsion", "first beaming"), shares.bending, strict=False))


def _body_motions(shares: Shares) -> dict[str, Floats]:
    """Cabin and powertrain on their mounts, and the two of them together."""
    scores = {}
    cabin, powertrain = shares.of_role("cabin"), shares.of_role("powertrain")
    if cabin:
        cab, (_, _, cab_heave, _, cab_pitch, yaw) = cabin
        scores[f"{cab} yaw"] = yaw
        if powertrain:
            engine, (_, _, heave, _, pitch, _) = powertrain
            both = 2 * np.sqrt((pitch + heave / 2) * (cab_heave + cab_pitch))
            scores[f"{engine} pitch and {cab} bounce"] = np.minimum(both, 1.0)
    if powertrain:
        engine, (_, _, _, roll, pitch, _) = powertrain
        scores |= {f"{engine} pitch": pitch, f"{engine} roll": roll}
    return scores
