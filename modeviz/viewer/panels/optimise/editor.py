"""What is optimised: the problem at a glance, and the controls that change it."""

from dataclasses import replace
from html import escape
from typing import get_args

import viser

from modeviz.analysis.results import Results
from modeviz.errors import ModevizError
from modeviz.files.problem_file import problem_text
from modeviz.optimise.design_space import design_space
from modeviz.optimise.place_checks import check_places
from modeviz.optimise.starts import MOST_STARTS
from modeviz.text.wording import file_name, sentence_case
from modeviz.vehicle.default_problem import problem_called, problems
from modeviz.vehicle.problem import GoalKind
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, span
from modeviz.viewer.panels.modes import listed
from modeviz.viewer.panels.optimise.accelerations import AccelerationsEditor
from modeviz.viewer.panels.optimise.bounds import BoundsEditor
from modeviz.viewer.panels.optimise.controls import Pills, PlanControls, may_change_hint
from modeviz.viewer.panels.optimise.places import PlacesEditor
from modeviz.viewer.panels.optimise.summary import summary
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.planning.plan import Plan, plan_of, planned
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import ORIGINAL, State

WORDS: dict[GoalKind, str] = {
    "peak": "Highest peak",
    "rms": "RMS on the road",
    "rating": "Ride rating",
    "iso 2631": "ISO 2631",
    "idle": "Idle quality",
    "forces": "Forces of mounts",
    "change": "Least change",
}
GOALS = {WORDS.get(goal) or sentence_case(goal): goal for goal in get_args(GoalKind)}
NO_MODE = "None"
BANDS = {"Within": True, "Out of": False}
SAVE = "Save problem"


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
        self._controls = PlanControls(gui, session)
        self._groups = _names(session.vehicle)
        with gui.add_folder("Problem"):
            self._summary = gui.add_html("")
            self._add_goal()
            self._pills = Pills(gui, "May change", self._groups, self._toggle)
            self._add_window(plan)
            self._controls.number(
                "Starts",
                (1, MOST_STARTS),
                lambda _, p: p.n_starts,
                lambda value: self._controls.put(n_starts=round(value)),
                "From how many designs to search: the present rates, and others spread over all that "
                "may be. More find a better minimum, and take longer",
            )
            self._controls.check(
                "Robust",
                lambda _, p: p.is_robust,
                lambda value: self._controls.put(is_robust=value),
                "From the best design on, search for one whose 95th percentile of vehicles with parts "
                "that differ is small, instead of the vehicle as drawn; takes some ten times as long",
            )
        self._bounds = BoundsEditor(gui, session)
        self._places = PlacesEditor(gui, session)
        self._accelerations = AccelerationsEditor(gui, session, plan)
        save = gui.add_button_group(
            "Keep",
            (SAVE,),
            hint="The problem as a file: modeviz optimise reads it with --problem, and its [[problem]] "
            "can be put into the vehicle's vehicle.toml",
        )
        save.on_click(self._save)

    def show(self, solved: Solved) -> None:
        """Brings the controls after the state, and says what is sought."""
        state = self._session.state
        plan = state.design.plan
        if plan is None:
            return
        assign(self._mode, options=tuple(self._modes(solved.named.results.get(ORIGINAL, solved.base))))
        self._controls.show()
        self._groups = _names(self._session.with_parts_of(state))
        self._pills.name(self._groups)
        for widget in self._band:
            assign(widget, visible=bool(plan.mode))
        self._pills.show([name in plan.free for name in self._groups], self._hints(plan))
        assign(self._summary, content=block(self._text(solved.state, plan)))
        self._bounds.show(state, plan)
        self._places.show()
        self._accelerations.show(plan)

    def _text(self, state: State, plan: Plan) -> str:
        vehicle = self._session.vehicle
        try:
            problem = planned(vehicle, plan)
            space = design_space(vehicle, problem.groups, state.design.rates, state.design.locked)
            check_places(vehicle, problem)
        except ModevizError as error:
            return span(escape(str(error)), "bad")
        return summary(problem, space, plan.is_robust)

    def _add_goal(self) -> None:
        """Builds the choice of a problem and of its goal."""
        choose, put = self._controls.choose, self._controls.put
        if len(known := problems(self._session.vehicle)) > 1:
            words = {sentence_case(problem.name): problem.name for problem in known}
            choose("Problem", words, lambda _, p: p.problem, self._take_problem, "Of this vehicle")
        choose(
            "Goal",
            GOALS,
            lambda _, p: p.goal,
            lambda goal: put(goal=goal),
            "What is to become small: the accelerations named above, or one figure of the whole ride; "
            "Least change is for a mode that has to be held somewhere",
        )
        self._controls.check(
            "Normalised",
            lambda _, p: p.is_normalised,
            lambda value: put(is_normalised=value),
            "Each load case relative to what it is with the original rates, so that units do not "
            "decide. Without it the accelerations are added as they are, as in the paper",
        )

    def _add_window(self, plan: Plan) -> None:
        """A mode to hold, and the band, which is only there with a mode."""
        put = self._controls.put
        self._named: dict[str, str] = {NO_MODE: ""} | (
            {sentence_case(plan.mode): plan.mode} if plan.mode else {}
        )
        self._mode = self._gui.add_dropdown(
            "Hold mode",
            tuple(self._named),
            initial_value=sentence_case(plan.mode) or NO_MODE,
            hint="A mode whose frequency has to be in a band, or out of it",
        )
        self._controls.bind(
            self._mode,
            lambda _, p: sentence_case(p.mode) or NO_MODE,
            lambda word: put(mode=self._named.get(word, "")),
        )
        side = self._controls.choose(
            "Band",
            BANDS,
            lambda _, p: p.is_inside,
            lambda value: put(is_inside=value),
            "Whether the mode has to be within the band, or out of it",
        )
        band = self._controls.pair(
            "From, to, Hz",
            lambda _, p: (p.low_hz, p.high_hz),
            lambda ends: put(low_hz=ends[0], high_hz=ends[1]),
            f"0 is no lower limit, {self._session.vehicle.highest_frequency:g} no upper one",
        )
        self._band = (side, band)

    def _modes(self, original: Results) -> list[str]:
        """Return the names of the modes that can be held."""
        names = [name.name for name, _ in listed(original).values()]
        plan = self._session.state.design.plan
        held = [plan.mode] if plan and plan.mode else []
        self._named = {NO_MODE: ""} | {sentence_case(name): name for name in [*held, *sorted(names)]}
        return list(self._named)

    def _hints(self, plan: Plan) -> list[str]:
        """Return what a click on each group does, by group."""
        vehicle = self._session.with_parts_of(self._session.state)
        now = {name: may_change_hint(name in plan.free) for name in self._groups}
        return [f"{vehicle.mount_group(name).label}: {hint}" for name, hint in now.items()]

    def _save(self, event: viser.GuiEvent) -> None:
        """Gives the problem to the page that asked for it."""
        plan, vehicle = self._session.state.design.plan, self._session.vehicle
        if event.client is None or plan is None:
            return
        try:
            problem = planned(vehicle, plan)
        except ModevizError as error:
            event.client.add_notification("Not saved", str(error), color="red")
            return
        name = file_name(f"{vehicle.name} {problem.name} problem", "toml")
        event.client.send_file_download(name, problem_text(problem).encode(), save_immediately=True)

    def _toggle(self, i: int) -> None:
        groups = self._groups
        if i < len(groups):  # else one was removed between the click and here
            self._controls.change(lambda _, plan: replace(plan, free=plan.free ^ {groups[i]}))

    def _take_problem(self, name: str) -> None:
        vehicle = self._session.vehicle
        found = problem_called(vehicle, name)
        self._controls.change(lambda _, plan: replace(plan_of(vehicle, found), n_starts=plan.n_starts))


def _names(vehicle: Vehicle) -> list[str]:
    """The names of all mount groups."""
    return [group.name for group in vehicle.mount_groups]
