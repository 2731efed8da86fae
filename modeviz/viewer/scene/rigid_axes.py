"""Lines and points of a body on its mounts: torque axes, elastic centre and axes, focus."""

from collections.abc import Iterator

import numpy as np
import viser
from viser.transforms import SO3

from modeviz.analysis.rigid import BodyAxes
from modeviz.mounting.axes import Line
from modeviz.shapes.colors import Color
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.scene.stage import Box, points_box
from modeviz.viewer.session.rigid_look import Support

ROLL, TORQUE, CENTER, FOCUS = (213, 94, 0), (0, 158, 115), (190, 110, 170), (230, 159, 0)
"""Of torque roll axis, elastic torque axis, elastic centre with its axes, and focus."""

BEYOND = 0.75
"""How far a line reaches to each side, as a part of the body's length with its mounts."""

ARM = 0.15
"""How long each of the principal elastic axes is to each side, likewise."""

POINT, THICK = 0.009, 0.0035
"""The radii of a point and of a line, as parts of the vehicle's length."""

UPRIGHT = np.array([1.0, 0.0, 0.0, 0.0])
"""The quaternion of what is not turned."""


class RigidAxesMarks:
    """The axes and centres of one body at a time."""

    def __init__(self, scene: viser.SceneApi, vehicle: Vehicle, length: float) -> None:
        """Makes what is drawn, and leaves it out.

        Args:
            scene: of the page.
            vehicle: whose bodies they may be of.
            length: of the vehicle, m.
        """
        self._lengths = {body.name: _box(vehicle, body.name).length for body in vehicle.bodies}
        thick, radius = THICK * length, POINT * length
        self._roll = _Axis(scene, "torque roll axis", thick, ROLL)
        self._torque = _Axis(scene, "elastic torque axis", thick, TORQUE)
        self._center = _Place(scene, "elastic centre", radius, CENTER)
        self._focus = _Place(scene, "focus", radius, FOCUS)
        self._arms = [
            _bar(scene, f"{self._center.path}/arm {i}", thick, CENTER, turn)
            for i, turn in enumerate(map(_turn, np.eye(3)))
        ]

    @property
    def label_names(self) -> list[str]:
        """The nodes of all labels."""
        return [mark.label for mark in (self._roll, self._torque, self._center, self._focus)]

    def hide(self) -> None:
        """Leaves all of it out."""
        for mark in (self._roll, self._torque):
            mark.show(None, 0.0)
        for mark in (self._center, self._focus):
            mark.show(None)

    def show(self, body: str, axes: BodyAxes, support: Support) -> None:
        """Draws the axes and centres of a body, as it is held or mounted."""
        length = self._lengths[body]
        elastic = axes.held if support == "held" else axes.mounted
        self._roll.show(axes.torque_roll_axis, BEYOND * length)
        self._torque.show(elastic.torque_axis if elastic else None, BEYOND * length)
        for arm in self._arms:
            assign(arm, scale=(1.0, 1.0, 2 * ARM * length))
        if elastic is None:
            self._center.show(None)
        else:
            turn = SO3.from_matrix(elastic.principal_axes.T).wxyz.astype(np.float64)
            self._center.show(elastic.center, turn)
        self._focus.show(axes.focus.point if axes.focus else None)


class _Moved:
    """A node of the scene that is told only where it has not been."""

    def __init__(self, scene: viser.SceneApi, path: str) -> None:
        self.path: str = path
        self._frame = scene.add_frame(path, show_axes=False, visible=False)

    def put(self, place: Floats | None, turn: Floats) -> None:
        """Puts it to a place, m, turned by a quaternion; None: leaves it out."""
        assign(self._frame, visible=place is not None)
        if place is None:
            return
        if not np.array_equal(self._frame.position, place):
            self._frame.position = place
        if not np.array_equal(self._frame.wxyz, turn):
            self._frame.wxyz = turn


class _Axis(_Moved):
    """A straight line, thick enough to be seen, with its name at its end."""

    def __init__(self, scene: viser.SceneApi, name: str, radius: float, color: Color) -> None:
        super().__init__(scene, f"/axes/{name}")
        self._bar = _bar(scene, f"{self.path}/bar", radius, color, UPRIGHT)
        self._end = scene.add_frame(f"{self.path}/end", show_axes=False)
        self.label: str = _named(scene, self._end.name, name)

    def show(self, line: Line | None, reach: float) -> None:
        """Draws it so far to both sides of its point, m; None: leaves it out."""
        if line is None:
            self.put(None, UPRIGHT)
            return
        assign(self._bar, scale=(1.0, 1.0, 2 * reach))
        forward = -np.sign(line.direction[:2].sum()) or 1.0  # the end that faces us
        end = np.array([0.0, 0.0, forward * reach])
        if not np.array_equal(self._end.position, end):
            self._end.position = end
        self.put(line.point, _turn(line.direction))


class _Place(_Moved):
    """A point with its name."""

    def __init__(self, scene: viser.SceneApi, name: str, radius: float, color: Color) -> None:
        super().__init__(scene, f"/axes/{name}")
        scene.add_icosphere(f"{self.path}/point", radius, color, cast_shadow=False)
        self.label: str = _named(scene, self.path, name)

    def show(self, place: Floats | None, turn: Floats | None = None) -> None:
        """Draws it at a place, m, with what hangs on it turned; None: leaves it out."""
        self.put(place, UPRIGHT if turn is None else turn)


def _bar(
    scene: viser.SceneApi, path: str, radius: float, color: Color, turn: Floats
) -> viser.CylinderHandle:
    """A cylinder of a length of one along z, turned."""
    return scene.add_cylinder(
        path, radius, 1.0, color=color, wxyz=turn, cast_shadow=False, receive_shadow=False
    )


def _named(scene: viser.SceneApi, parent: str, text: str) -> str:
    """The node of a label that stays apart from others."""
    name = f"{parent}/text"
    scene.add_label(name, text, anchor="center-center", font_screen_scale=0.8)
    return name


def _turn(direction: Floats) -> Floats:
    """The quaternion that lays z along a direction."""
    across = np.cross(direction, np.eye(3)[np.argmin(np.abs(direction))])
    across /= np.linalg.norm(across)
    basis = np.stack([across, np.cross(direction, across), direction], axis=1).real
    return SO3.from_matrix(basis).wxyz.astype(np.float64)


def _box(vehicle: Vehicle, body: str) -> Box:
    """The space that a body takes with what holds it."""
    mesh = [part.vertices for part in vehicle.body(body).mesh]
    return points_box([*mesh, *_ends(vehicle, body)])


def _ends(vehicle: Vehicle, body: str) -> Iterator[Floats]:
    for connection in vehicle.all_connections:
        if body in connection.bodies:
            yield connection.points
