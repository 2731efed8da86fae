"""The mark of one mount: its rubber or damper, its name, and its axes once it is selected."""

import math
from collections.abc import Callable, Collection

import numpy as np
import viser
from viser.transforms import SO3

from modeviz.errors import cut
from modeviz.shapes.colors import Color
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.mount_group import MountGroup
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.scene.labels import LABEL_LETTERS
from modeviz.viewer.scene.mark_colors import RUBBER, SELECTED, STEEL
from modeviz.viewer.scene.mount_looks import HEIGHT, RADIUS, mount_look
from modeviz.viewer.scene.rings import ring

SIZE_STEP = 0.05
"""Of a marker's size, 2 mm on a pickup: no eye sees it, and a drag changes few markers at a time."""

TRIAD = 0.045
"""Length of the local axes of a selected mount, x red, y green, z blue, as a part of the vehicle's."""

RING_RADIUS = 0.024
"""Of the ring around a mount, likewise."""


class MountMarker:
    """A mount along its own axes, with its name; selected, with these; see `mount_look`."""

    def __init__(self, scene: viser.SceneApi, mount: Mount, group: MountGroup, length: float) -> None:
        """Draws a mount at rest and not selected; the length of its vehicle, m, gives its size."""
        self._length = length
        self._label_text = short_name(mount, group)
        self._looks: tuple[float, bool, bool, Color] | None = None
        axes = SO3.from_matrix(mount.axes.T).wxyz
        path = f"/mounts/{mount.name.replace('/', '-')}"
        self._bodies = mount.bodies
        self._frame = scene.add_frame(
            path,
            show_axes=False,
            axes_length=TRIAD * length,
            axes_radius=TRIAD * length / 18,
            origin_radius=TRIAD * length / 15,
            wxyz=axes,
            position=mount.center,
        )
        self._look = look = mount_look(mount)
        self._pieces = [
            scene.add_cylinder(
                f"{path}/{piece.name}",
                piece.radius * RADIUS * length,
                piece.height * HEIGHT * length,
                color=RUBBER if i == 0 else STEEL,
                cast_shadow=False,
                wxyz=look.turn.wxyz,
            )
            for i, piece in enumerate(look.pieces)
        ]
        self._ring = scene.add_line_segments(
            f"{path}/ring",
            ring(RING_RADIUS * length, RING_RADIUS * length),
            SELECTED,
            thickness=3.0,
            thickness_units="screen",
            visible=False,
        )
        self.label_name: str = f"{path}/name"
        self._label = scene.add_label(
            self.label_name, self._label_text, anchor="center-center", font_screen_scale=0.85
        )

    def place(self, mount: Mount) -> None:
        """Draws the mount where it is, along its local axes."""
        wxyz = SO3.from_matrix(mount.axes.T).wxyz
        if not np.array_equal(wxyz, self._frame.wxyz):
            self._frame.wxyz = wxyz
        if not np.array_equal(mount.center, self._frame.position):
            self._frame.position = mount.center

    def remove(self) -> None:
        """Takes it out of the page."""
        self._frame.remove()

    def on_click(self, callback: Callable[[], None]) -> None:
        """Calls back when the mount is clicked."""
        for piece in self._pieces:
            piece.on_click(lambda _: callback())

    def hide(self, bodies: Collection[str]) -> None:
        """Leaves the mount out while both bodies that it joins are."""
        assign(self._frame, visible=self.is_seen(bodies))

    def is_seen(self, hidden: Collection[str]) -> bool:
        """Whether it is drawn where these bodies are not."""
        return not hidden or not set(self._bodies) <= set(hidden)

    def show(self, share: float, selected: bool, carded: bool, color: Color = RUBBER) -> None:
        """Draws the mount by its share of the largest group's energy, and as selected or not.

        Args:
            share: 0 to 1.
            selected: whether its group is.
            carded: whether the group's card hangs on this mount and names it.
            color: sRGB of its rubber, or what else it is, while it is not selected.
        """
        size = SIZE_STEP * round((0.6 + 0.9 * math.sqrt(share)) / SIZE_STEP)
        looks = (size, selected, carded, color)
        if looks == self._looks:
            return
        self._looks = looks
        assign(self._pieces[0], color=SELECTED if selected else color)
        unit = HEIGHT * size * self._length
        for drawn, piece in zip(self._pieces, self._look.pieces, strict=True):
            assign(drawn, scale=size)
            if piece.along:
                drawn.position = piece.along * unit * self._look.direction
        assign(self._ring, visible=selected)
        assign(self._frame, show_axes=selected)
        assign(self._label, visible=not carded)


def short_name(mount: Mount, group: MountGroup) -> str:
    """Return a group's name and what tells its mounts apart, the initial if that does: "C1 L".

    Mounts that are not called after their group keep their names.
    """
    if len(group.mounts) == 1:
        return cut(group.name, LABEL_LETTERS)
    sides = {m.name: m.name.removeprefix(group.name).strip() for m in group.mounts}
    initials = {side[:1] for name, side in sides.items() if side != name}
    side = sides[mount.name][:1].upper() if len(initials) == len(sides) else sides[mount.name]
    return cut(f"{group.name} {side}".strip(), LABEL_LETTERS)
