"""What a mount group may become: its free directions, bounds and ratios."""

from dataclasses import replace
from functools import partial
from typing import Any

import viser

from modeviz.files.schema.scaling import written
from modeviz.text.wording import sentence_case
from modeviz.units import factor
from modeviz.vehicle.mount_rates import DIRECTIONS, RATE_FIELDS
from modeviz.viewer.page.handles import assign
from modeviz.viewer.panels.optimise.controls import Pills, PlanControls, complaint, may_change_hint
from modeviz.viewer.session.planning.group_plan import Ratios
from modeviz.viewer.session.planning.plan import Plan
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

RATIOS: dict[str, Ratios] = {"Within limits": "limited", "Kept": "fixed", "Free": "free"}


class BoundsEditor:
    """The limits of one mount group of the plan."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls, folded up.

        Args:
            gui: where.
            session: whose state has a plan.
        """
        self._vehicle = session.vehicle
        self._controls = controls = PlanControls(gui, session)
        with gui.add_folder("Bounds and ratios", expand_by_default=False):
            controls.choose(
                "Mounts",
                {group.title: group.name for group in session.vehicle.mount_groups},
                lambda _, plan: plan.shown_group,
                lambda name: controls.put(shown_group=name),
                "Whose limits are shown here",
            )
            self._directions = Pills(
                gui, "May change", [sentence_case(d) for d in DIRECTIONS], self._toggle
            )
            self._bounds = [self._bound(field, DIRECTIONS[i]) for i, field in enumerate(RATE_FIELDS)]
            controls.choose(
                "Ratios",
                RATIOS,
                lambda _, plan: plan.group.ratios,
                lambda ratios: self._put(ratios=ratios),
                "Lateral and fore-aft by vertical: within limits, as they are at the start of the "
                "search, or free",
            )
            self._limits = controls.pair(
                "Limits",
                lambda _, plan: plan.group.ratio_limits,
                lambda limits: self._put(ratio_limits=limits),
                "The least and the most that lateral and fore-aft may be of vertical",
            )
            assign(self._limits, step=0.05)
            self._wrong = gui.add_html("")

    def show(self, state: State, plan: Plan) -> None:
        """Brings the controls after the state."""
        self._controls.show()
        for bound, direction in zip(self._bounds, DIRECTIONS, strict=True):
            assign(bound, label=f"{sentence_case(direction)}, {state.unit}")
        assign(self._limits, visible=plan.group.ratios == "limited")
        pressed = [direction in plan.group.directions for direction in DIRECTIONS]
        self._directions.show(pressed, [may_change_hint(on) for on in pressed])
        mounts = self._vehicle.mount_group(plan.shown_group)
        assign(self._wrong, content=complaint(partial(plan.group.design, mounts)))

    def _bound(self, field: str, direction: str) -> viser.GuiVector2Handle:
        """Boxes for the softest and the stiffest of one rate."""

        def read(state: State, plan: Plan) -> tuple[float, ...]:
            ends, unit = (plan.group.softest, plan.group.stiffest), factor(state.unit, "stiffness")
            return tuple(written(getattr(end, field), unit) for end in ends)

        def write(typed: tuple[float, float]) -> None:
            self._controls.change(lambda state, plan: bounded(plan, field, typed, state.unit))

        hint = f"The softest and the stiffest {direction} rate that a search may choose"
        return self._controls.pair(sentence_case(direction), read, write, hint)

    def _toggle(self, i: int) -> None:
        def toggled(_: State, plan: Plan) -> Plan:
            return plan.with_group(directions=plan.group.directions ^ {DIRECTIONS[i]})

        self._controls.change(toggled)

    def _put(self, **fields: Any) -> None:
        self._controls.change(lambda _, plan: plan.with_group(**fields))


def bounded(plan: Plan, field: str, typed: tuple[float, float], unit: str) -> Plan:
    """The plan with other bounds to a rate of the group that is shown; only what differs is changed."""
    per_unit = factor(unit, "stiffness")
    ends = {"softest": typed[0], "stiffest": typed[1]}
    changed = {}
    for name, value in ends.items():
        rates = getattr(plan.group, name)
        if written(getattr(rates, field), per_unit) != value:
            changed[name] = replace(rates, **{field: value * per_unit})
    return plan.with_group(**changed)
