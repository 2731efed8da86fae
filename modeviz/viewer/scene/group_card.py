"""The card of the selected group, beside one of its mounts, and what it says."""

from collections.abc import Mapping, Sequence
from textwrap import fill

import numpy as np
import viser

from modeviz.report.rate_fields import direction, quantity, sections
from modeviz.units import QuantityName, factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.scene.mark_colors import SELECTED
from modeviz.viewer.scene.mount_looks import has_springs

CARD_LETTERS = 50
"""In a line: with more the card would find no place."""

CARD = "/card"
"""Stands at the mount that the card hangs on."""

CARD_TEXT, CARD_LINE = f"{CARD}/text", f"{CARD}/line"


class GroupCard:
    """A card on the selected group, beside one of its mounts."""

    def __init__(self, scene: viser.SceneApi) -> None:
        """Makes an empty card."""
        self._frame = scene.add_frame(CARD, show_axes=False, visible=False)
        self._label = scene.add_label(CARD_TEXT, "", anchor="center-center")
        scene.add_line_segments(
            CARD_LINE,
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
