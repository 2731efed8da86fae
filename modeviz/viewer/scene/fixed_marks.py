"""Marks that stay where they are: response points and tyre patches."""

from collections.abc import Collection

import viser

from modeviz.errors import cut
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.scene.labels import LABEL_LETTERS
from modeviz.viewer.scene.mark_colors import BLUE
from modeviz.viewer.scene.rings import ring

POINT_RADIUS = 0.007
"""Of a response point, as a part of the vehicle's length."""

PATCH = (0.026, 0.0185)
"""Half length and half width of the ring around a tyre patch, as parts of the vehicle's length."""

PATCH_Z = 7e-4
"""Of its height above the ground."""

Marks = list[tuple[viser.SceneNodeHandle, str]]
"""What marks points of bodies, each with the name of its body."""


class FixedMarks:
    """The response points and tyre patches of a vehicle."""

    def __init__(self, scene: viser.SceneApi, vehicle: Vehicle, length: float) -> None:
        """Draws them; the length of the vehicle, m, gives their sizes."""
        self._marks = _add_points(scene, vehicle, length) + _add_patches(scene, vehicle, length)
        self.label_names: tuple[str, ...] = tuple(map(_label_path, vehicle.response_points))

    def hide(self, bodies: Collection[str]) -> None:
        """Leaves out those of bodies that are not drawn."""
        for mark, body in self._marks:
            assign(mark, visible=body not in bodies)

    def are_seen(self, hidden: Collection[str]) -> bool:
        """Return whether one of them is, where these bodies are not drawn."""
        return any(body not in hidden for _, body in self._marks)


def _add_points(scene: viser.SceneApi, vehicle: Vehicle, length: float) -> Marks:
    """The response points; only those on our side are named, which is enough and less to read."""
    marks: Marks = []
    for point in vehicle.response_points:
        path = _point_path(point)
        mark = scene.add_icosphere(
            path, POINT_RADIUS * length, BLUE, position=point.position, cast_shadow=False
        )
        marks.append((mark, point.body))
        if point.position[1] <= 0:
            scene.add_label(
                _label_path(point),
                cut(point.name, LABEL_LETTERS),
                anchor="center-center",
                font_screen_scale=0.8,
            )
    return marks


def _point_path(point: ResponsePoint) -> str:
    return f"/points/{point.name.replace('/', '-')}"


def _label_path(point: ResponsePoint) -> str:
    return f"{_point_path(point)}/name"


def _add_patches(scene: viser.SceneApi, vehicle: Vehicle, length: float) -> Marks:
    """The tyre patches."""
    marks: Marks = []
    for tyre in vehicle.tyres:
        x, y, _ = tyre.points[1]
        mark = scene.add_line_segments(
            f"/patches/{tyre.name.replace('/', '-')}",
            ring(*(length * part for part in PATCH)),
            BLUE,
            thickness=2.0,
            thickness_units="screen",
            position=(x, y, PATCH_Z * length),
        )
        marks.append((mark, tyre.bodies[0]))
    return marks
