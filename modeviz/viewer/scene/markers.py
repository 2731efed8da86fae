"""Marks on the vehicle: its mounts, the selected group's card, response points and tyre patches."""

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from textwrap import fill

import numpy as np
import viser
from viser.transforms import SO3

from modeviz.errors import cut
from modeviz.report.rate_fields import direction, quantity, sections
from modeviz.shapes.colors import Color
from modeviz.units import QuantityName, factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.placement import Placement, Placements, placed_mounts
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.handles import assign
from modeviz.viewer.scene.labels import keep_apart
from modeviz.viewer.scene.mount_looks import HEIGHT, RADIUS, STEEL, has_springs, mount_look
from modeviz.viewer.scene.stage import Theme

RUBBER, SELECTED, BLUE = (236, 190, 96), (242, 140, 24), (43, 124, 196)

SIZE_STEP = 0.05
"""Of a marker's size, 2 mm on a pickup: no eye sees it, and a drag changes few markers at a time."""

TRIAD = 0.045
"""Length of the local axes of a selected mount, x red, y green, z blue, likewise."""

RING_RADIUS = 0.024
"""Of the ring around a mount, as a part of the vehicle's length."""

POINT_RADIUS = 0.007
"""Of a response point, as a part of the vehicle's length."""

LABEL_LETTERS, CARD_LETTERS = 24, 50
"""In a label, and in a line of the card: with more they would find no place."""

CARD = "/card"
"""Stands at the mount that the card hangs on."""

PATCH = (0.026, 0.0185)
"""Half length and half width of the ring around a tyre patch, as parts of the vehicle's length."""

PATCH_Z = 7e-4
"""Of its height above the ground."""


Marks = list[tuple[viser.SceneNodeHandle, str]]
"""What marks points of bodies, each with the name of its body."""


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
            _ellipse(RING_RADIUS * length, RING_RADIUS * length),
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


class Card:
    """A card on the selected group, beside one of its mounts."""

    def __init__(self, scene: viser.SceneApi) -> None:
        """Makes an empty card."""
        self._frame = scene.add_frame(CARD, show_axes=False, visible=False)
        self._label = scene.add_label(f"{CARD}/text", "", anchor="center-center")
        scene.add_line_segments(
            f"{CARD}/line",
            np.array([[[0, 0, 0], [1, 0, 0]]], np.float32),
            SELECTED,
            thickness=2.0,
            thickness_units="screen",
        )

    def show(self, text: str, mount: Floats) -> None:
        """Hangs the card on a mount; an empty text puts it away."""
        assign(self._frame, visible=bool(text))
        assign(self._label, text=text)
        self.move(mount)

    def move(self, mount: Floats) -> None:
        """Hangs it where its mount is."""
        if not np.array_equal(mount, self._frame.position):
            self._frame.position = mount


class Markers:
    """All marks of a vehicle."""

    def __init__(
        self,
        scene: viser.SceneApi,
        vehicle: Vehicle,
        theme: Theme,
        length: float,
        on_select: Callable[[str], None],
        other_labels: Sequence[str] = (),
    ) -> None:
        """Draws them in sizes that go with the vehicle's.

        Args:
            scene: of the page.
            vehicle: whose marks they are.
            theme: of the scene.
            length: of the vehicle, m.
            on_select: called with the group of a clicked mount.
            other_labels: nodes of labels that are to stay apart from those of the marks.
        """
        self._scene, self._theme, self._length, self._on_select = scene, theme, length, on_select
        self._given: dict[str, MountGroup] = {}
        self._groups: dict[str, MountGroup] = {}
        self._placed: Placements = {}
        self._carded = ""
        self._mounts: dict[str, list[MountMarker]] = {}
        self._nearest: dict[str, int] = {}
        self._card = Card(scene)
        self._others = _add_points(scene, vehicle, length) + _add_patches(scene, vehicle, length)
        points = [f"{_point_path(point)}/name" for point in vehicle.response_points]
        self._other_labels = [*points, *other_labels]
        self._take({group.name: group for group in vehicle.mount_groups})

    def hold(self, vehicle: Vehicle) -> None:
        """Marks the mounts of a vehicle, and no others; those of groups that it has already stay."""
        groups = {group.name: group for group in vehicle.mount_groups}
        if self._given.keys() != groups.keys():
            self._take(groups)

    def _take(self, groups: Mapping[str, MountGroup]) -> None:
        for name in self._given.keys() - groups.keys():
            self._forget(name)
        for name, group in groups.items():
            if name not in self._given:
                self._mark(group)
        labels = [marker.label_name for markers in self._mounts.values() for marker in markers]
        keep_apart(
            self._scene,
            [*labels, *self._other_labels],
            f"{CARD}/text",
            f"{CARD}/line",
            self._theme,
        )

    def _mark(self, group: MountGroup) -> None:
        """Marks the mounts of a group where they were given."""
        name = group.name
        markers = [MountMarker(self._scene, mount, group, self._length) for mount in group.mounts]
        for marker in markers:
            marker.on_click(lambda: self._on_select(name))
        self._given[name] = self._groups[name] = group
        self._mounts[name], self._nearest[name] = markers, _nearest_to_us(group)
        self._place(name)

    def _forget(self, name: str) -> None:
        """Takes the marks of a group out of the page."""
        for marker in self._mounts.pop(name):
            marker.remove()
        del self._given[name], self._groups[name], self._nearest[name]
        if self._carded == name:
            self._carded = ""

    def hide(self, bodies: Collection[str]) -> None:
        """Leaves out what hangs on nothing but bodies that are not drawn."""
        for markers in self._mounts.values():
            for marker in markers:
                marker.hide(bodies)
        for mark, body in self._others:
            assign(mark, visible=body not in bodies)

    def place(self, placements: Placements) -> None:
        """Draws the mounts where they are placed, and the card where its mount is."""
        if placements == self._placed:
            return
        self._placed = placements
        for name in self._given:
            self._place(name)
        if self._carded:
            self._card.move(self._groups[self._carded].mounts[self._nearest[self._carded]].center)

    def _place(self, name: str) -> None:
        """Draws the mounts of a group where they are placed."""
        given = self._given[name]
        mounts = placed_mounts(given, self._placed.get(name, Placement()))
        self._groups[name] = replace(given, mounts=mounts)
        for marker, mount in zip(self._mounts[name], mounts, strict=True):
            marker.place(mount)

    def carrier(self, group: str) -> int:
        """The number of the mount of a group that carries its card."""
        return self._nearest[group]

    def are_seen(self, hidden: Collection[str]) -> bool:
        """Whether one of them is, where these bodies are not drawn."""
        mounts = (marker for markers in self._mounts.values() for marker in markers)
        return any(marker.is_seen(hidden) for marker in mounts) or any(
            body not in hidden for _, body in self._others
        )

    def show(
        self,
        selected: str,
        rates: Mapping[str, MountRates],
        units: Mapping[QuantityName, str],
        shares: Mapping[str, float],
        mode: str,
        colors: Mapping[str, Color],
    ) -> None:
        """Draws each group by its share of a mode's strain energy, and the selected one's card.

        Args:
            selected: name of a group, or "" for none.
            rates: what the card says.
            units: in which the card says them.
            shares: of the mode's strain energy, by group.
            mode: what the mode is called.
            colors: sRGB, by group, of those whose colour means something.
        """
        largest = max(shares.values(), default=0.0) or 1.0
        for name, markers in self._mounts.items():
            is_selected = name == selected
            for i, marker in enumerate(markers):
                is_carded = is_selected and i == self._nearest[name]
                color = colors.get(name, RUBBER)
                marker.show(shares[name] / largest, is_selected, is_carded, color)
        group = self._groups.get(selected)
        self._carded = selected if group else ""
        if group is None:
            self._card.show("", np.zeros(3))
        else:
            text = card_text(group, rates[selected], units, shares[selected], mode)
            self._card.show(text, group.mounts[self._nearest[selected]].center)


def card_text(
    group: MountGroup, rates: MountRates, units: Mapping[QuantityName, str], share: float, mode: str
) -> str:
    """Return the text of a group's card: name, mounts, tuned rates and share of a mode's energy."""
    sides = " + ".join(mount.name.removeprefix(group.name).strip() for mount in group.mounts)
    title = group.title + (f", {sides}" if sides else "")
    values = [_values(rates, kind, its, units) for kind, its in sections(group.fields)]
    energy = [f"{100 * share:.0f} % of strain energy in {mode}"] * any(map(has_springs, group.mounts))
    lines = (title, *values, *energy)
    return "\n".join(fill(line, CARD_LETTERS, replace_whitespace=False) for line in lines)


def _values(
    rates: MountRates, kind: str, fields: Sequence[str], units: Mapping[QuantityName, str]
) -> str:
    """Rates of one quantity in a line, "damping: vertical 1600 N s/m"."""
    of = quantity(fields[0])
    per_unit = factor(units[of], of)
    said = (f"{direction(field)} {_short(getattr(rates, field) / per_unit)}" for field in fields)
    return f"{kind.lower()}: ".removeprefix(": ") + f"{'  '.join(said)} {units[of]}"


def _short(rate: float) -> str:
    """A rate to three digits, those before the point in full."""
    return f"{rate:.0f}" if rate >= 100 else f"{rate:.3g}"


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


def _nearest_to_us(group: MountGroup) -> int:
    """Return the mount of a group on which the card hangs."""
    return int(np.argmin([mount.center[1] for mount in group.mounts]))


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
                f"{path}/name",
                cut(point.name, LABEL_LETTERS),
                anchor="center-center",
                font_screen_scale=0.8,
            )
    return marks


def _point_path(point: ResponsePoint) -> str:
    return f"/points/{point.name.replace('/', '-')}"


def _add_patches(scene: viser.SceneApi, vehicle: Vehicle, length: float) -> Marks:
    """The tyre patches."""
    marks: Marks = []
    for tyre in vehicle.tyres:
        x, y, _ = tyre.points[1]
        mark = scene.add_line_segments(
            f"/patches/{tyre.name.replace('/', '-')}",
            _ellipse(*(length * part for part in PATCH)),
            BLUE,
            thickness=2.0,
            thickness_units="screen",
            position=(x, y, PATCH_Z * length),
        )
        marks.append((mark, tyre.bodies[0]))
    return marks


def _ellipse(along_x: float, along_y: float) -> np.ndarray:
    """A closed ellipse as line segments, (48, 2, 3)."""
    angle = np.linspace(0, 2 * np.pi, 49)
    points = np.stack([along_x * np.cos(angle), along_y * np.sin(angle), 0 * angle], axis=1)
    return np.stack([points[:-1], points[1:]], axis=1).astype(np.float32)
