"""A body as it is drawn: its surface, and the outlines that are its ghost unless it is rigid."""

from collections.abc import Mapping
from typing import Self
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from modeviz.shapes.gltf import glb
from modeviz.shapes.motion import displacement, vertex_shapes
from modeviz.shapes.stand_in import drawn_mesh
from modeviz.shapes.surface import Surface, outlines, surface, vertex_areas
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Body, RigidBody
from modeviz.viewer.scene.driver import AT_REST, ShapeDriver
from modeviz.viewer.scene.stage import Theme

SHEET_ROLES = ("cabin", "bed")
"""Bodies that hide others: they are seen through, and their edges are drawn."""

SEE_THROUGH = 0.5


def is_sheet(body: Body) -> bool:
    """Whether a body hides others."""
    return body.role in SHEET_ROLES or not (body.mesh or body.role == "absorber")


class DrawnBody:
    """A body's meshes in the page, and what moves them."""

    def __init__(
        self,
        driver: ShapeDriver,
        name: str,
        drawn: Surface,
        shapes: NDArray[np.float32],
        theme: Theme,
        *,
        is_rigid: bool = False,
        is_sheet: bool = False,
        has_ghost: bool = True,
    ) -> None:
        """Draws a body at rest.

        Args:
            driver: of the page.
            name: of the body.
            drawn: its surface.
            shapes: (n_coordinates, n_vertices, 3), how that moves, from `vertex_shapes`.
            theme: of the scene.
            is_rigid: whether its coordinates are x, y, z, rx, ry, rz.
            is_sheet: whether it hides others, is seen through, and its edges are drawn.
            has_ghost: whether it has outlines.
        """
        self.name: str = name
        part = name.replace("/", "-")
        self.path: str = f"/vehicle/{part}"
        self._ghost_path = f"/ghost/{part}"
        self._driver, self._shapes = driver, shapes
        self._is_rigid, self._is_sheet, self._has_ghost = is_rigid, is_sheet, has_ghost
        self.areas: Floats = vertex_areas(drawn)
        edge_color = theme.edges if self._is_sheet else None
        driver.add(self.path, glb(drawn, edge_color), len(drawn.vertices), cast_shadow=True)
        if self._has_ghost:
            ghost, kept = outlines(drawn)
            self._ghost_shapes = self._shapes[:, kept]
            driver.add(self._ghost_path, glb(ghost, theme.ghost), len(ghost.vertices))

    @classmethod
    def of(cls, driver: ShapeDriver, body: Body, theme: Theme) -> Self:
        """Return a body of a vehicle, drawn at rest."""
        drawn, shapes = _moving_surface(body)
        is_rigid, sheet = isinstance(body, RigidBody), is_sheet(body)
        return cls(
            driver,
            body.name,
            drawn,
            shapes,
            theme,
            is_rigid=is_rigid,
            is_sheet=sheet,
            # Those of axles, wheels and engine would be many lines that tell little.
            has_ghost=sheet or not is_rigid,
        )

    def displacement(self, coordinates: Array) -> Array:
        """Return the displacement of every vertex, (n_vertices, 3), of the coordinates' type."""
        return displacement(self._shapes, coordinates)

    def points(self, shape: Array, motion: Array, other: Array | None) -> Mapping[str, Array]:
        """Return the points that the driver shows of the body; a rigid one travels as its motion.

        Args:
            shape: the displacement of its vertices, (n_vertices, 3).
            motion: the coordinates it comes from, (n_coordinates,).
            other: those that its outlines show; without them they rest.
        """
        points = {self.path: np.stack([shape[0], motion[3:]]) if self._is_rigid else shape}
        if self._has_ghost:
            ghost = AT_REST if other is None else displacement(self._ghost_shapes, other)
            points[self._ghost_path] = ghost
        return points

    def show(self, visible: bool, see_through: bool, ghost: bool) -> None:
        """Draws the body or leaves it out, and its outlines."""
        self._driver.set_visible(self.path, visible)
        if self._is_sheet:
            self._driver.set_opacity(self.path, SEE_THROUGH if see_through else 1.0)
        if self._has_ghost:
            self._driver.set_visible(self._ghost_path, visible and ghost)

    def remove(self) -> None:
        """Takes the body and its outlines out of the page."""
        self._driver.remove(self.path)
        if self._has_ghost:
            self._driver.remove(self._ghost_path)


def _moving_surface(body: Body) -> tuple[Surface, NDArray[np.float32]]:
    """A body's surface and how that moves: large, and the same in every session of a vehicle."""
    if body not in _surfaces:
        drawn = surface(drawn_mesh(body))
        _surfaces[body] = drawn, vertex_shapes(body, drawn.vertices)
    return _surfaces[body]


_surfaces: WeakKeyDictionary[Body, tuple[Surface, NDArray[np.float32]]] = WeakKeyDictionary()
"""Of bodies that somebody still has."""
