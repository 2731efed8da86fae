"""All marks on a vehicle: its mounts, the selected group's card, response points and tyre patches."""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np
import viser

from modeviz.shapes.colors import Color
from modeviz.units import QuantityName
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.placement import Placement, Placements, placed_mounts
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.scene.fixed_marks import FixedMarks
from modeviz.viewer.scene.group_card import CARD_LINE, CARD_TEXT, GroupCard, card_text
from modeviz.viewer.scene.labels import keep_apart
from modeviz.viewer.scene.mark_colors import RUBBER
from modeviz.viewer.scene.mount_marker import MountMarker
from modeviz.viewer.scene.stage import Theme


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
        self._card = GroupCard(scene)
        self._fixed = FixedMarks(scene, vehicle, length)
        self._other_labels = [*self._fixed.label_names, *other_labels]
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
            CARD_TEXT,
            CARD_LINE,
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
        self._fixed.hide(bodies)

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
        return any(marker.is_seen(hidden) for marker in mounts) or self._fixed.are_seen(hidden)

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


def _nearest_to_us(group: MountGroup) -> int:
    """Return the mount of a group on which the card hangs."""
    return int(np.argmin([mount.center[1] for mount in group.mounts]))
