"""What is optimised: the problem at a glance, and the controls that change it."""

from collections.abc import Callable
from dataclasses import replace
from html import escape
from typing import Any, get_args

import viser

from modeviz.dynamics.basis import TOP_HZ
from modeviz.errors import ModevizError
from modeviz.export.wording import sentence_case
from modeviz.tuning.design import design_space
from modeviz.tuning.results import Results
from modeviz.vehicle.problem import Goal
from modeviz.viewer.answers import Solved
from modeviz.viewer.assign import assign
from modeviz.viewer.binding import Binding, show_all
from modeviz.viewer.html import HiddenButtons, block, span
from modeviz.viewer.panels.modes import listed
from modeviz.viewer.panels.optimise.summary import summary
from modeviz.viewer.plan import Plan, plan_of, planned, problems
from modeviz.viewer.session import Session
from modeviz.viewer.settle import WriteBack
from modeviz.viewer.state import ORIGINAL, State

WORDS: dict[Goal, str] = {
    "peak": "Highest peak",
    "rms": "RMS on the road",
    "rating": "Ride rating",
    "iso 2631": "ISO 2631",
    "change": "Least change",
}
GOALS = {WORDS.get(goal) or sentence_case(goal): goal for goal in get_args(Goal)}
NO_MODE = "None"
BANDS = {"Within": True, "Out of": False}
MOST_STARTS = 200


class ProblemEditor:
    """The problem of a session's plan."""

    def __init__(self, gui: viser.GuiApi, session: Session, plan: Plan) -> None:
        """Builds the controls.

        Args:
            gui: where.
            session: whose state has a plan.
            plan: that plan.
        """
        self._gui, self._session = gui, session
        self._write_back = WriteBack()
        self._groups = [group.name for group in session.vehicle.mount_groups]
        self._buttons = HiddenButtons(gui, len(self._groups), self._toggle)
        self._summary = gui.add_html("")
        self._bindings: list[Binding] = []
        if len(known := problems(session.vehicle)) > 1:
            words = {sentence_case(name): name for name in known}
            self._choose("Problem", words, lambda p: p.problem, self._take_problem, "Of this vehicle")
        self._choose(
            "Goal",
            GOALS,
            lambda p: p.goal,
            lambda goal: self._plan(goal=goal),
            "What is to become small: the accelerations named above, or one figure of the whole ride; "
            "Least change is for a mode that has to be held somewhere",
        )
        normalised = gui.add_checkbox(
            "Normalised",
            plan.is_normalised,
            hint="Each load case relative to what it is with the original rates, so that units do not "
            "decide. Without it the accelerations are added as they are, as in the paper",
        )
        self._bind(normalised, lambda p: p.is_normalised, lambda v: self._plan(is_normalised=v))
        self._pills = gui.add_html("")
        self._add_window(plan)
        self._starts = self._number(
            "Starts",
            "n_starts",
            plan.n_starts,
            (1, MOST_STARTS),
            "From how many designs to search: the present rates, and others spread over all that may "
            "be. More find a better minimum, and take longer",
        )

    def show(self, solved: Solved) -> None:
        """Brings the controls after the state, and says what is sought."""
        plan = self._session.state.plan
        if plan is None:
            return
        assign(self._mode, options=tuple(self._modes(solved.named.get(ORIGINAL, solved.base))))
        show_all(self._bindings)
        for widget in self._band:
            assign(widget, visible=bool(plan.mode))
        assign(self._pills, content=block(self._free(plan)))
        assign(self._summary, content=block(self._text(solved.state, plan)))

    def _text(self, state: State, plan: Plan) -> str:
        vehicle = self._session.vehicle
        try:
            problem = planned(vehicle, plan)
            space = design_space(vehicle, problem.groups, state.rates, state.locked)
        except ModevizError as error:
            return span(escape(str(error)), "bad")
        return summary(problem, space)

    def _add_window(self, plan: Plan) -> None:
        """A mode to hold, and the band, which is only there with a mode."""
        modes = {NO_MODE: ""} | ({sentence_case(plan.mode): plan.mode} if plan.mode else {})
        self._mode = self._gui.add_dropdown(
            "Hold mode",
            tuple(modes),
            initial_value=sentence_case(plan.mode) or NO_MODE,
            hint="A mode whose frequency has to be in a band, or out of it",
        )
        self._bind(
            self._mode,
            lambda p: sentence_case(p.mode) or NO_MODE,
            lambda word: self._plan(mode=self._named.get(word, "")),
        )
        self._named: dict[str, str] = modes
        side = self._choose(
            "Band",
            BANDS,
            lambda p: p.is_inside,
            lambda value: self._plan(is_inside=value),
            "Whether the mode has to be within the band, or out of it",
        )
        limits = (0.0, TOP_HZ)
        low = self._number("From, Hz", "low_hz", plan.low_hz, limits, "0: no lower limit")
        high = self._number("To, Hz", "high_hz", plan.high_hz, limits, f"{TOP_HZ:g}: no upper limit")
        self._band = (side, low, high)

    def _modes(self, original: Results) -> list[str]:
        """What the modes are called that can be held."""
        names = [name.name for name, _ in listed(original).values()]
        plan = self._session.state.plan
        held = [plan.mode] if plan and plan.mode else []
        self._named = {NO_MODE: ""} | {sentence_case(name): name for name in [*held, *sorted(names)]}
        return list(self._named)

    def _free(self, plan: Plan) -> str:
        """A pill for each group, pressed if its rates may change."""
        pills = []
        for i, name in enumerate(self._groups):
            label = self._session.vehicle.mount_group(name).label
            may = name in plan.groups
            hint = f"{label}: {'may change; click to hold' if may else 'held; click to free'}"
            text = self._buttons.label(i, f'<span title="{escape(hint)}">{escape(name)}</span>')
            pills.append(f'<div class="pill{" on" if may else ""}">{text}</div>')
        return f'<div class="pills"><span class="dim">May change</span>{"".join(pills)}</div>'

    def _toggle(self, i: int) -> None:
        group = self._groups[i]
        self._change(lambda plan: replace(plan, groups=plan.groups ^ {group}))

    def _take_problem(self, name: str) -> None:
        found = problems(self._session.vehicle)[name]
        self._change(lambda plan: replace(plan_of(found), n_starts=plan.n_starts))

    def _plan(self, **fields: Any) -> None:
        self._change(lambda plan: replace(plan, **fields))

    def _change(self, change: Callable[[Plan], Plan]) -> None:
        def changed(state: State) -> State:
            return replace(state, plan=change(state.plan)) if state.plan else state

        self._session.update(changed)

    def _choose(
        self,
        label: str,
        words: dict[str, Any],
        read: Callable[[Plan], Any],
        write: Callable[[Any], None],
        hint: str,
    ) -> viser.GuiInputHandle:
        """A dropdown of values by what they are called."""
        called = {value: word for word, value in words.items()}
        plan = self._session.state.plan
        assert plan is not None
        dropdown = self._gui.add_dropdown(
            label, tuple(words), initial_value=called[read(plan)], hint=hint
        )
        self._bind(dropdown, lambda p: called[read(p)], lambda word: write(words[word]))
        return dropdown

    def _number(
        self, label: str, field: str, value: float, limits: tuple[float, float], hint: str
    ) -> viser.GuiInputHandle:
        """A box for a number of the plan."""
        box = self._gui.add_number(label, value, min=limits[0], max=limits[1], step=1, hint=hint)
        self._bind(box, lambda p: getattr(p, field), lambda v: self._plan(**{field: v}), typed=True)
        return box

    def _bind(
        self,
        widget: viser.GuiInputHandle,
        read: Callable[[Plan], Any],
        write: Callable[[Any], None],
        typed: bool = False,
    ) -> None:
        """Binds a widget to a part of the plan."""

        def read_state(state: State) -> Any:
            return read(state.plan) if state.plan else widget.value

        write_back = self._write_back if typed else None
        self._bindings.append(Binding(widget, self._session, read_state, write, write_back, typed))
