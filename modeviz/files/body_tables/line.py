"""A line of a table of bodies as the record of a rigid body."""

from typing import get_args

import numpy as np

from modeviz.errors import VehicleError, quoted, unknown
from modeviz.files.body_tables.columns import CENTER, CRANK, MOMENTS, POINT, PRODUCTS
from modeviz.files.columns import bare
from modeviz.files.headed_table import TableLine
from modeviz.files.records.bodies import RigidBodyRecord
from modeviz.files.records.record import tuples
from modeviz.files.schema.quantities import Vector
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Role
from modeviz.vehicle.connections import GROUND
from modeviz.vehicle.inertia import impossible

CENTER_OF_GRAVITY = ("", "cg", "cog", "com", "centerofgravity", "centreofgravity", "centerofmass")
"""What may stand in `inertia_at` for it."""


class BodyLine(TableLine):
    """The line of a body."""

    def record(self) -> RigidBodyRecord:
        """The body of this line, in SI and the axes of the vehicle's file."""
        name = self.required("name", "the body's name")
        if name == GROUND:
            raise VehicleError(
                f"{self.where('name')}: {GROUND!r} means what does not move; take another"
            )
        for column in ("mass", *CENTER, *MOMENTS):
            self.required(column, "a number")
        mass, center = self._above_zero("mass"), self.near_place(CENTER)
        assert center is not None
        inertia = self._inertia(mass, center)
        products = (0.0 - inertia[[0, 0, 1], [1, 2, 2]]).tolist()
        return RigidBodyRecord(
            name=name,
            role=self._role(),
            label=self.text("label"),
            mesh=self.text("mesh") or None,
            mesh_unit=self.text("mesh_unit") or None,
            crank_axis=self._crank(),
            mass=mass,
            center_of_gravity=tuples(center),
            inertia=(*np.diag(inertia).tolist(), *products),
        )

    def _crank(self) -> Vector | None:
        """The direction of its crank, if the line has one."""
        direction = self.place(CRANK)
        if direction is None:
            return None
        if not direction.any():
            raise VehicleError(f"{self.where(CRANK[0])}: found 0, 0, 0, expected a direction")
        return tuples(direction)

    def _above_zero(self, name: str) -> float:
        value = self.number(name)
        if value is None or value <= 0:
            raise VehicleError(f"{self.where(name)}: found {self.text(name)}, expected more than 0")
        return value

    def _role(self) -> Role:
        text = self.text("role") or "other"
        for role in get_args(Role):
            if text.lower() == role:
                return role
        raise VehicleError(f"{self.where('role')}: {unknown('role', text, get_args(Role))}")

    def _inertia(self, mass: float, center: Floats) -> Floats:
        """The matrix (3, 3) about the centre of gravity, of that about the point which the line says.

        I_P = I + m (r·r 1 - r rᵀ), r from that point to the centre of gravity (Steiner).
        """
        matrix = np.diag([self._above_zero(name) for name in MOMENTS])
        for (row, column), product in zip(((0, 1), (0, 2), (1, 2)), PRODUCTS, strict=True):
            given, negative = self.number(product), self.number(f"-{product}")
            matrix[row, column] = matrix[column, row] = (negative or 0.0) - (given or 0.0)
        r = center - self._point(center)
        matrix = matrix - mass * (r @ r * np.eye(3) - np.outer(r, r))
        where = f"line {self.row.line}, columns {self.columns['ixx'].header} and others"
        about = ", taken to the centre of gravity" if r.any() else ""
        small = np.linalg.eigvalsh(matrix)[0]
        if small <= 0:
            raise VehicleError(
                f"{where}: the least principal moment{about} is {small:.4g} kg m², expected more than 0"
            )
        if reason := impossible(matrix):
            raise VehicleError(f"{where}: {reason}{about}, as of no body")
        return matrix

    def _point(self, center: Floats) -> Floats:
        """The point about which the line gives its inertia, (3,), m."""
        text, point = self.text("inertia_at"), self.near_place(POINT)
        where, names = self.where("inertia_at"), ", ".join(POINT)
        match bare(text):
            case "point":
                if point is None:
                    raise VehicleError(f"{where}: found {quoted(text)}, expected it in {names}")
                return point
            case _ if point is not None:
                raise VehicleError(f"{where}: found {quoted(text)} beside {names}, expected 'point'")
            case "origin":
                return np.zeros(3)
            case words if words in CENTER_OF_GRAVITY:
                return center
        raise VehicleError(
            f"{where}: found {quoted(text)}, expected 'center of gravity', 'origin' or 'point', which "
            f"is in {names}"
        )
