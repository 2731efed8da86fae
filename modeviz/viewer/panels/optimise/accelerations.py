"""Which accelerations are to become small: loads, frequencies, points and directions."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import viser

from modeviz.text.wording import sentence_case
from modeviz.vehicle.mount_rates import DIRECTIONS
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.panels.optimise.controls import Pills, PlanControls, complaint
from modeviz.viewer.session.planning.load_plan import LoadPlan
from modeviz.viewer.session.planning.plan import Plan
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

ADD, REMOVE = "Add", "Remove"
NONE = "None"


class AccelerationsEditor:
    """The accelerations of the plan, a term of them at a time."""

    def __init__(self, gui: viser.GuiApi, session: Session, plan: Plan) -> None:
        """Builds the controls, folded up.

        Args:
            gui: where.
            session: whose state has a plan.
            plan: that plan.
        """
        vehicle = self._vehicle = session.vehicle
        self._gui, self._controls = gui, PlanControls(gui, session)
        self._roads = [road.name for road in vehicle.offered_loads]
        self._wheel_loads = [load.name for load in vehicle.harmonic_loads]
        self._points = [point.name for point in vehicle.response_points]
        with gui.add_folder("Loads and points", expand_by_default=False):
            self._edit = gui.add_button_group(
                "Terms",
                (ADD, REMOVE),
                hint="One more term of the sum, as the one that is shown to begin with; or the shown "
                "one away",
            )
            self._edit.on_click(lambda _: self._add_or_remove(self._edit.value))
            self._shown = gui.add_folder(None)
            with self._shown:
                self._add_term(plan)

    def show(self, plan: Plan) -> None:
        """Brings the controls after the state."""
        assign(self._edit, options=(ADD, REMOVE) if plan.loads else (ADD,))
        assign(self._shown, visible=bool(plan.loads))
        assign(self._term, options=terms(plan))
        self._controls.show()
        for pills, names, chosen in (
            (self._road_pills, self._roads, plan.load.roads),
            (self._load_pills, self._wheel_loads, plan.load.wheel_loads),
            (self._point_pills, self._points, plan.load.points),
            (self._direction_pills, DIRECTIONS, plan.load.directions),
        ):
            pills.show([name in chosen for name in names], names)
        assign(self._wrong, content=complaint(partial(plan.load.performance, self._vehicle)))

    def _add_term(self, plan: Plan) -> None:
        """The controls of the term that is shown."""
        gui, controls = self._gui, self._controls
        self._term = gui.add_dropdown(
            "Term",
            terms(plan),
            initial_value=terms(plan)[plan.shown_load],
            hint="Which term of the sum is shown here",
        )
        controls.bind(
            self._term,
            lambda _, plan: terms(plan)[plan.shown_load],
            lambda word: controls.change(lambda _, plan: showing(plan, word)),
        )
        self._road_pills = self._pills("Roads", self._roads, "roads")
        self._load_pills = self._pills("Wheels", self._wheel_loads, "wheel_loads")
        controls.text(
            "At, Hz",
            lambda _, plan: plan.load.frequencies,
            lambda text: self._put(frequencies=text),
            "Frequencies: numbers and ranges, as in 11, 13.25 or 6 to 14 by 1/3; the highest peak is "
            "that of all from the first to the last",
        )
        self._point_pills = self._pills("Points", self._points, "points")
        self._direction_pills = self._pills("Along", DIRECTIONS, "directions")
        controls.number(
            "Target",
            (0.0, None),
            lambda _, plan: plan.load.target,
            lambda value: self._put(target=value),
            "What each of them is wanted to be: g under a wheel load, g/√Hz on a road",
        )
        controls.number(
            "Weight",
            (0.0, None),
            lambda _, plan: plan.load.weight,
            lambda value: self._put(weight=value),
            "Of this term in the sum",
        )
        self._wrong = gui.add_html("")

    def _pills(self, label: str, names: Sequence[str], field: str) -> Pills:
        """Names of which some are in a field of the shown term."""

        def toggle(i: int) -> None:
            def toggled(_: State, plan: Plan) -> Plan:
                return plan.with_load(**{field: getattr(plan.load, field) ^ {names[i]}})

            self._controls.change(toggled)

        return Pills(self._gui, label, [sentence_case(name) for name in names], toggle)

    def _add_or_remove(self, button: str) -> None:
        change = Plan.with_one_more_load if button == ADD else Plan.without_load
        self._controls.change(lambda _, plan: change(plan))

    def _put(self, **fields: Any) -> None:
        self._controls.change(lambda _, plan: plan.with_load(**fields))


def terms(plan: Plan) -> tuple[str, ...]:
    """Return the names of the terms: "1 Road 1", "2 12 wheel loads"; a word where there is none."""
    return tuple(f"{i}  {_loads(load)}" for i, load in enumerate(plan.loads, 1)) or (NONE,)


def showing(plan: Plan, term: str) -> Plan:
    """The plan with the term of that name shown."""
    known = terms(plan)
    return replace(plan, shown_load=known.index(term)) if term in known else plan


def _loads(load: LoadPlan) -> str:
    kinds = ((load.roads, "roads"), (load.wheel_loads, "wheel loads"))
    named = [next(iter(n)) if len(n) == 1 else f"{len(n)} {kind}" for n, kind in kinds if n]
    return sentence_case(" and ".join(named)) or "No load"
