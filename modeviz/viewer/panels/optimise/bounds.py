"""What a mount group may become: its free rates, bounds and ratios."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import viser

from modeviz.files.schema.scaling import written
from modeviz.report.rate_fields import fields_of_groups, is_damping, quantity, spoken
from modeviz.text.wording import in_a_box, sentence_case
from modeviz.units import QuantityName, factor
from modeviz.vehicle.mount_rates import DAMPING_FIELDS, RATE_FIELDS, STIFFNESS_FIELDS
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.widgets.handles import assign
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
        self._session = session
        self._controls = controls = PlanControls(gui, session)
        with gui.add_folder("Bounds and ratios", expand_by_default=False):
            self._shown = self._choice_of_group(gui)
            self._fields = _fields_of(session.vehicle)
            words = [sentence_case(spoken(field)) for field in self._fields]
            self._free = Pills(gui, "May change", words, self._toggle)
            self._bounds = [self._bound(field) for field in self._fields]
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
        vehicle = self._session.with_parts_of(state)
        assign(self._shown, options=tuple(group.title for group in vehicle.mount_groups))
        self._controls.show()
        mounts = vehicle.mount_group(plan.shown_group)
        for bound, field in zip(self._bounds, self._fields, strict=True):
            label = f"{sentence_case(spoken(field))}, {state.units[quantity(field)]}"
            assign(bound, label=label, visible=field in mounts.fields)
        assign(self._limits, visible=plan.group.ratios == "limited")
        pressed = {field: field in plan.group.free for field in self._fields}
        self._free.show(
            [pressed[field] if field in mounts.fields else None for field in self._fields],
            [may_change_hint(on) for on in pressed.values()],
        )
        assign(self._wrong, content=complaint(partial(plan.group.design, mounts)))

    def _choice_of_group(self, gui: viser.GuiApi) -> viser.GuiDropdownHandle[str]:
        """The mount group whose limits are shown."""

        def title(state: State, plan: Plan) -> str:
            return self._session.with_parts_of(state).mount_group(plan.shown_group).title

        def choose(title: str) -> None:
            names = {group.title: group.name for group in self._session.vehicle.mount_groups}
            self._controls.put(shown_group=names[title])

        titles = tuple(group.title for group in self._session.vehicle.mount_groups)
        choice = gui.add_dropdown("Mounts", titles, hint="Whose limits are shown here")
        return self._controls.bind(choice, title, choose)

    def _bound(self, field: str) -> viser.GuiVector2Handle:
        """Boxes for the least and the most of one rate."""

        def read(state: State, plan: Plan) -> tuple[float, ...]:
            unit = factor(state.units[quantity(field)], quantity(field))
            ends = plan.group.softest, plan.group.stiffest
            return tuple(in_a_box(written(getattr(end, field), unit)) for end in ends)

        def write(typed: tuple[float, float]) -> None:
            self._controls.change(lambda state, plan: bounded(plan, field, typed, state.units))

        ends = "least and the most" if is_damping(field) else "softest and the stiffest"
        hint = f"The {ends} {spoken(field)} rate that a search may choose"
        return self._controls.pair(sentence_case(spoken(field)), read, write, hint)

    def _toggle(self, i: int) -> None:
        def toggled(_: State, plan: Plan) -> Plan:
            return plan.with_group(free=plan.group.free ^ {self._fields[i]})

        self._controls.change(toggled)

    def _put(self, **fields: Any) -> None:
        self._controls.change(lambda _, plan: plan.with_group(**fields))


def bounded(
    plan: Plan, field: str, typed: tuple[float, float], units: Mapping[QuantityName, str]
) -> Plan:
    """The plan with other bounds to a rate of the group that is shown; only what differs is changed."""
    per_unit = factor(units[quantity(field)], quantity(field))
    ends = {"softest": typed[0], "stiffest": typed[1]}
    changed = {}
    for name, value in ends.items():
        rates = getattr(plan.group, name)
        if in_a_box(written(getattr(rates, field), per_unit)) != value:
            changed[name] = replace(rates, **{field: value * per_unit})
    return plan.with_group(**changed)


def _fields_of(vehicle: Vehicle) -> tuple[str, ...]:
    """The rates that are tuned in one of a vehicle's groups, or in an absorber that is added to it."""
    tuned = {*fields_of_groups(vehicle.mount_groups), *STIFFNESS_FIELDS, *DAMPING_FIELDS}
    return tuple(field for field in RATE_FIELDS if field in tuned)
