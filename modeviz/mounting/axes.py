"""Axes and centres of a body on its mounts: torque roll axis, elastic torque axis, elastic centre."""

from dataclasses import dataclass

import numpy as np

from modeviz.mounting.frames import principal_axes
from modeviz.mounting.rigid_part import RigidPart
from modeviz.vehicle.arrays import Floats

PARALLEL = 1e-9
"""The sine of an angle below which two lines are parallel."""


@dataclass(frozen=True, eq=False)
class Line:
    """A line in space."""

    point: Floats
    """(3,), m: one of its points, the nearest to the body's centre of gravity."""
    direction: Floats
    """(3,), a unit vector."""


@dataclass(frozen=True, eq=False)
class ElasticAxes:
    """How a body moves when it is pushed and turned at rest."""

    torque_axis: Line | None
    """The elastic torque axis: about it the body turns under a torque about its crank; None if that
    does not turn it."""
    pitch: float
    """m/rad: how far it moves along that axis as it turns about it."""
    angle: float
    """rad, between that and the torque roll axis."""
    offset: float
    """m: the shortest distance of both lines."""
    center: Floats | None
    """(3,), m: the elastic centre, see `elastic_axes`; None if it is held along less than two axes."""
    principal_axes: Floats
    """(3, 3) as rows, in the order of the vehicle's axes."""
    rates: Floats
    """(3,), N/m along them, the body kept from turning."""
    lines: tuple[Line | None, ...]
    """One along each: a force along it moves the body without turning it, but for `moments`."""
    moments: Floats
    """(3,), m: the moment about its line that this needs besides, per unit of force."""

    @property
    def spread(self) -> float:
        """How far its lines are from the elastic centre, m, the root of the mean square."""
        known = [line for line in self.lines if line is not None]
        if self.center is None or not known:
            return 0.0
        off = [np.cross(self.center - line.point, line.direction) for line in known]
        return float(np.sqrt(np.mean(np.sum(np.square(off), axis=1))))


def torque_roll_axis(part: RigidPart, crank: Floats) -> Line | None:
    """Return the axis about which a free body begins to turn under a torque about its crank.

    J⁻¹c through the centre of gravity (T. Jeong, R. Singh, Journal of Sound and Vibration 234(1),
    2000); None of a rod along the crank.

    Args:
        part: of the body.
        crank: c, (3,), a unit vector.
    """
    turn = part.inverse_mass[3:, 3:] @ crank
    size = float(np.linalg.norm(turn))
    return Line(part.center, turn / size) if size > 0 else None


def elastic_axes(center: Floats, compliance: Floats, crank: Floats, roll: Line | None) -> ElasticAxes:
    """Return the axes of a body that is held, of its motion per force and moment.

    Every force along a principal axis of the translational stiffness has a line on which it moves the
    body without turning it. Where the three meet is the elastic centre; where they pass each other, it
    is the point nearest to them, by least squares with their rates as weights. That is the centre of
    stiffness, at which force by rotation is symmetric (J. Lončarić, "Normal forms of stiffness and
    compliance matrices", IEEE Journal of Robotics and Automation 3(6), 1987); of upright mounts it is
    their mean, weighted with their rates.

    Args:
        center: of gravity, (3,), m.
        compliance: (6, 6) there, see `mounting.stiffness`.
        crank: (3,), a unit vector.
        roll: the torque roll axis.
    """
    axis, pitch = _screw(center, compliance[:, 3:] @ crank)
    angle, offset = _between(axis, roll)
    K = _inverse(compliance)
    A, moment = K[:3, :3], K[3:, :3]
    rates, axes = principal_axes(A)
    arms = np.cross(axes, axes @ moment.T)
    has_rate = rates > PARALLEL * max(float(rates.max()), np.finfo(float).tiny)
    held = np.where(has_rate, rates, np.inf)
    lines = tuple(
        Line(center + arm / rate, e) if known else None
        for arm, rate, e, known in zip(arms, held, axes, has_rate, strict=True)
    )
    middle = None
    if has_rate.sum() > 1:
        middle = center + np.linalg.solve(np.trace(A) * np.eye(3) - A, arms.sum(axis=0))
    moments = np.einsum("ij,ij->i", axes, axes @ moment.T) / held
    return ElasticAxes(axis, pitch, angle, offset, middle, axes, rates, lines, moments)


def _screw(center: Floats, motion: Floats) -> tuple[Line | None, float]:
    """The line about which a motion (6,) of a centre turns, and how far it moves along it, m/rad."""
    shift, turn = motion[:3], motion[3:]
    square = float(turn @ turn)
    if not square > 0:
        return None, 0.0
    line = Line(center + np.cross(turn, shift) / square, turn / np.sqrt(square))
    return line, float(turn @ shift / square)


def _between(one: Line | None, other: Line | None) -> tuple[float, float]:
    """The angle of two lines, rad, and their distance, m; not a number where one is missing."""
    if one is None or other is None:
        return np.nan, np.nan
    normal, apart = np.cross(one.direction, other.direction), other.point - one.point
    sine = float(np.linalg.norm(normal))
    angle = float(np.arctan2(sine, one.direction @ other.direction))
    if sine < PARALLEL:
        return angle, float(np.linalg.norm(np.cross(apart, one.direction)))
    return angle, abs(float(apart @ normal)) / sine


def _inverse(compliance: Floats) -> Floats:
    """The stiffness of a compliance, zero where that is: what is rigid has no rate of its own."""
    scale = np.sqrt(np.diag(compliance))
    scale = np.where(scale > 0, scale, 1.0)
    K = np.linalg.pinv(compliance / np.outer(scale, scale), rcond=1e-12, hermitian=True)
    return K / np.outer(scale, scale)
