"""Doubts about the modes of a body whose numbers, each by itself, could be right.

Rigid modes are held against the rigid motions they ought to be, modal mass against the mass that is
stated, and frequencies against those that bodies have.
"""

from collections.abc import Iterator

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.inertia import impossible
from modeviz.vehicle.vehicle import Vehicle

SLIGHT = 0.01
"""What rigid motions, masses and scales may be off, a part of them, before it is worth a word."""

ROTATION_UNITS = {
    180 / np.pi: "as if they were in degrees",
    1e3: "as if they were in mrad",
    1e-3: "as if the translations were in mm",
    0.0254: "as if the translations were in inches",
}
"""What makes rotations so many times as large as translations say."""

ALIKE = 1e-4
"""How much the largest motions of max-normalised modes may differ."""

LOW_HZ = 10.0
"""Hardly a body has all its elastic modes below this."""


def doubts(vehicle: Vehicle) -> Iterator[str]:
    """Sentences on what is likely wrong with a vehicle."""
    for body in vehicle.bodies:
        if isinstance(body, FlexibleBody):
            for doubt in (*_of_rigid_modes(body), *_of_mass(body), *_of_elastic_modes(body)):
                yield f"body {body.name!r}: {doubt}"
    for tyre in vehicle.tyres:
        if tyre.is_in_the_middle and tyre.track is None:
            yield (
                f"tyre {tyre.name!r} stands on neither side, so it follows the mean of both tracks; "
                'track = "left", "right" or "both" says which'
            )


def road_doubts(vehicle: Vehicle) -> Iterator[str]:
    """Sentences on roads that do not get into a vehicle."""
    why = "has no tyre with stiffness along its z" if vehicle.tyres else "has no [[tyre]]"
    for road in vehicle.roads:
        if not vehicle.is_shaken_by(road):
            yield (
                f"road {road.name!r}: does nothing, as the vehicle {why}; springs to the ground carry "
                "no road, [[base_motion]] moves those"
            )


def _of_rigid_modes(body: FlexibleBody) -> Iterator[str]:
    """A sentence if the rigid modes do not move the attachments as one rigid body."""
    if not body.attachments:
        return
    found = np.array([a.shapes[:, : body.n_rigid] for a in body.attachments])
    fitted = body.rigid_fit.moved(np.array([a.position for a in body.attachments]))
    for what, rows in (("translations", slice(0, 3)), ("rotations", slice(3, 6))):
        have, want = found[:, rows], fitted[:, rows]
        if have.any() and (text := _misfit(have, want)):
            at, part, scale = text
            yield (
                f"its rigid modes are not rigid: the {what} of attachment "
                f"{body.attachments[at].name!r} are {part:.0%} off the rigid motion fitted over all"
                f"{_in_other_units(what, scale)}"
            )


def _misfit(have: Floats, want: Floats) -> tuple[int, float, float] | None:
    """The attachment that is off most, by what part of the largest motion, and the scale of all."""
    off = np.linalg.norm(have - want, axis=(1, 2))
    size = np.linalg.norm(want, axis=(1, 2)).max()
    at = int(off.argmax())
    if off[at] <= SLIGHT * size:
        return None
    return at, off[at] / size if size else np.inf, float(np.sum(have * want) / np.sum(want**2))


def _in_other_units(what: str, scale: float) -> str:
    """A likely reason why motions are so many times as large as they ought to be."""
    reasons = [words for factor, words in ROTATION_UNITS.items() if abs(scale / factor - 1) < 0.05]
    if what == "rotations" and reasons:
        return f"; they are {scale:.3g} times as large, {reasons[0]}"
    return ""


def _of_mass(body: FlexibleBody) -> Iterator[str]:
    """A sentence if the mass by the rigid modes is that of no body, or not of this one."""
    fit = body.rigid_fit
    moving, turning = fit.mass_about_center_of_gravity
    along = np.diag(moving)
    if np.ptp(along) > SLIGHT * along.max():
        x, y, z = along
        yield (
            f"its rigid modes say that it weighs {x:.4g} kg along x, {y:.4g} along y and {z:.4g} along "
            "z; modes have to be mass-normalised (φᵀMφ = I) and orthogonal"
        )
    elif body.stated_mass is not None and abs(body.mass / body.stated_mass - 1) > SLIGHT:
        yield (
            f"its rigid modes say that it weighs {body.mass:.4g} kg, its mass is stated as "
            f"{body.stated_mass:.4g} kg; modes have to be mass-normalised (φᵀMφ = I) in kg and m"
        )
    elif reason := impossible(turning, SLIGHT):
        yield f"its rigid modes say inertias that no body has: {reason}"


def _of_elastic_modes(body: FlexibleBody) -> Iterator[str]:
    """Sentences where modes do not look mass-normalised, or ω² not rising in rad²/s²."""
    normal = slice(body.n_rigid, body.n_normal)
    f = body.natural_frequency_hz[normal]
    if not f.size:
        return
    largest = np.abs(body.shapes[:, :3, normal]).max(axis=(0, 1), initial=0.0)
    if len(f) > 1 and largest.max() and np.ptp(largest) < ALIKE * largest.max():
        yield (
            f"the largest motion is {largest.max():.4g} in every mode, as if all were max-normalised; "
            "they have to be mass-normalised (φᵀMφ = I)"
        )
    if (np.diff(f) < 0).any():
        yield "its elastic modes do not rise in frequency; keep_modes keeps the first"
    if f.max() < LOW_HZ:
        squares = body.omega_n_squared[normal]
        yield (
            f"its elastic modes are at {f.min():.3g} to {f.max():.3g} Hz; omega_n_squared has to be "
            f"(2π f)² in rad²/s²: are its numbers, {squares.min():.3g} to {squares.max():.3g}, in Hz "
            "or rad/s?"
        )
