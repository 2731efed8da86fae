"""How far the mounts of a group may be moved and turned by a search."""

import viser

from modeviz.files.schema.scaling import written
from modeviz.optimise.place_variables import UNITS, Kind
from modeviz.vehicle.local_axes import AXES
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.panels.optimise.controls import PlanControls
from modeviz.viewer.session.planning.plan import Plan
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

MOVE = {"offset": "Move", "angles": "Turn"}
ALONG = {"offset": "along", "angles": "about"}


class PlacesEditor:
    """The bounds of the places of the mount group that the plan shows."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls, folded up.

        Args:
            gui: where.
            session: whose state has a plan.
        """
        self._controls = PlanControls(gui, session)
        with gui.add_folder("Places of these mounts", expand_by_default=False):
            for kind in UNITS:
                for axis in range(3):
                    self._add(kind, axis)

    def show(self) -> None:
        """Brings the controls after the state."""
        self._controls.show()

    def _add(self, kind: Kind, axis: int) -> None:
        """Adds boxes for the least and the most of one number."""
        unit, size = UNITS[kind]

        def read(_: State, plan: Plan) -> tuple[float, ...]:
            return tuple(written(end, size) for end in ranges_of(plan, kind)[axis])

        def write(typed: tuple[float, float]) -> None:
            self._controls.change(lambda _, plan: ranged(plan, kind, axis, typed))

        boxes = self._controls.pair(
            f"{MOVE[kind]} {AXES[axis]}, {unit}",
            read,
            write,
            f"The least and the most that a search may {MOVE[kind].lower()} these mounts {ALONG[kind]} "
            f"{AXES[axis]}, on the other side of the vehicle as in a mirror; twice zero: not at all",
        )
        assign(boxes, min=None)


def ranges_of(plan: Plan, kind: Kind) -> tuple[tuple[float, float], ...]:
    """Return the ranges along, or about, x, y and z of the group that is shown."""
    return plan.group.offsets if kind == "offset" else plan.group.angles


def ranged(plan: Plan, kind: Kind, axis: int, typed: tuple[float, float]) -> Plan:
    """Return the plan with another range, in the unit that is shown; the same leaves it as it is."""
    size = UNITS[kind][1]
    ranges = list(ranges_of(plan, kind))
    if tuple(written(end, size) for end in ranges[axis]) == typed:
        return plan
    ranges[axis] = typed[0] * size, typed[1] * size
    return plan.with_group(**{"offsets" if kind == "offset" else "angles": tuple(ranges)})
