"""Where the mounts of a group sit and how they are turned: numbers, and a handle in the scene."""

import numpy as np
import viser

from modeviz.vehicle.local_axes import AXES
from modeviz.vehicle.mount_group import MountGroup
from modeviz.viewer.page.binding import Binding
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.session.commands.decisions import PlaceMounts, ResetPlacement
from modeviz.viewer.session.commands.looks import ChangeLook
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

TURN_STEP, LARGEST_TURN = 0.5, 90.0
"""Degrees."""

OFFSET_STEP = 1.0
"""mm."""

DECIMALS = 6
"""Of mm and degrees: more is rounding."""

AS_IN_A_MIRROR = "those on the other side as in a mirror"


class Placing:
    """Controls of one group, put away until they are wanted."""

    def __init__(self, gui: viser.GuiApi, session: Session, group: MountGroup) -> None:
        """Builds them.

        Args:
            gui: where.
            session: what they change.
            group: whose they are.
        """
        self._session, self._name = session, group.name
        which = f"{group.mounts[0].name} and mounts on its side; {AS_IN_A_MIRROR}"
        with gui.add_folder("Place", expand_by_default=False):
            moved = gui.add_vector3(
                "Moved, mm",
                self._offset(session.state),
                step=OFFSET_STEP,
                hint=f"From where the file has them, along the vehicle's axes: {which}",
            )
            turned = [self._add_turn(gui, axis, which) for axis in range(len(AXES))]
            handle = gui.add_checkbox(
                "Handle",
                session.state.look.handle,
                hint="Arrows and arcs at the selected group, to drag its mounts with",
            )
            reset = gui.add_button("Reset place", hint="Where the file has them, as they are there")
        reset.on_click(lambda _: session.do(ResetPlacement(group.name)))
        self.bindings: tuple[Binding[State], ...] = (
            Binding(moved, session, self._offset, self._move, WriteBack(), typed=True),
            *turned,
            Binding(
                handle,
                session,
                lambda state: state.look.handle,
                lambda on: session.do(ChangeLook(handle=on)),
            ),
        )

    def _add_turn(self, gui: viser.GuiApi, axis: int, which: str) -> Binding[State]:
        """Adds a slider for how they are turned about an axis."""

        def angle(state: State) -> float:
            angles = state.design.alterations.placement(self._name).angles
            return round(float(np.degrees(angles[axis])), DECIMALS)

        def turn(degrees: float) -> None:
            x, y, z = (float(np.radians(degrees)) if i == axis else None for i in range(3))
            self._session.do(PlaceMounts(self._name, "angles", (x, y, z)))

        slider = gui.add_slider(
            f"About {AXES[axis]}, °",
            -LARGEST_TURN,
            LARGEST_TURN,
            TURN_STEP,
            angle(self._session.state),
            marks=(0.0,),
            hint=f"Out of the axes in the file, about the vehicle's x, then y, then z: {which}",
        )
        return Binding(slider, self._session, angle, turn, WriteBack())

    def _offset(self, state: State) -> tuple[float, float, float]:
        offset = state.design.alterations.placement(self._name).offset
        x, y, z = (round(1e3 * value, DECIMALS) for value in offset)
        return x, y, z

    def _move(self, offset: tuple[float, float, float]) -> None:
        x, y, z = (1e-3 * value for value in offset)
        self._session.do(PlaceMounts(self._name, "offset", (x, y, z)))
