"""Left column: mount rates optimised while one watches."""

import threading
from collections.abc import Callable
from html import escape

import viser

from modeviz.errors import ModevizError, VehicleError
from modeviz.vehicle.default_problem import problems
from modeviz.viewer.page.widgets.alerts import refuse
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, span
from modeviz.viewer.panels.optimise.editor import ProblemEditor
from modeviz.viewer.panels.optimise.fall import FallChart
from modeviz.viewer.panels.optimise.outcome import exactness, figures, limits, truncation, where
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State
from modeviz.viewer.tasks.search_task import SearchStatus, SearchTask, design_of

START, PAUSE, RESUME, CANCEL = "Start", "Pause", "Resume", "Cancel"
ACCEPT, GO_BACK = "Accept", "Go back"
OFFERED: dict[str, tuple[str, ...]] = {
    "preparing": (PAUSE, CANCEL),
    "searching": (PAUSE, CANCEL),
    "paused": (RESUME, CANCEL),
    "checking": (),
}


class OptimisePanel:
    """The problem, the search for better rates, and what came of it."""

    def __init__(self, gui: viser.GuiApi, session: Session, optimiser: SearchTask, dark: bool) -> None:
        """Builds the controls; of a vehicle without a problem it says what is missing.

        Args:
            gui: where.
            session: whose plan is carried out.
            optimiser: of that session.
            dark: whether the page is dark.
        """
        self._session, self._optimiser = session, optimiser
        self._lock = threading.Lock()
        self._editor: ProblemEditor | None = None
        plan = session.state.design.plan
        if plan is None:
            gui.add_html(block(span(escape(_missing(session)), "dim")))
            return
        self._editor = ProblemEditor(gui, session, plan)
        self._buttons = gui.add_button_group(
            "Search",
            (START,),
            hint="Start from the present rates, hold, or end; the truck follows the best design so far "
            "until somebody moves a rate. Accept pins the result, Go back takes the rates before",
        )
        self._buttons.on_click(lambda event: self._press(self._buttons.value, event))
        self._where = gui.add_html("")
        self._fall = FallChart(gui, dark)
        self._result = gui.add_html("")
        self._presses: dict[str, Callable[[], None]] = {
            START: optimiser.start,
            PAUSE: optimiser.pause,
            RESUME: optimiser.resume,
            CANCEL: optimiser.cancel,
            ACCEPT: optimiser.accept,
            GO_BACK: optimiser.go_back,
        }

    def show(self, solved: Solved) -> None:
        """Brings the controls after the state."""
        if self._editor is not None:
            self._editor.show(solved)
            with self._lock:
                self._offer()

    def follow(self) -> None:
        """Draws where the search is; may be called in any thread."""
        with self._lock:  # else an older look could be drawn over a newer one
            look = self._optimiser.job
            if look is None:
                return
            self._offer()
            assign(self._where, content=block(where(look), figures(look)))
            if look.history:
                self._fall.show(look)
            else:
                self._fall.hide()
            assign(self._result, content=self._outcome(look))

    def _outcome(self, look: SearchStatus) -> str:
        if look.found is None:
            return ""
        verdicts = (exactness(look.found), truncation(look.found))
        return block(limits(look.found), *(f"<div>{verdict}</div>" for verdict in verdicts if verdict))

    def _offer(self) -> None:
        """Offers what can be done now."""
        assign(self._buttons, options=offered(self._optimiser.job, self._session.state))

    def _press(self, button: str, event: viser.GuiEvent) -> None:
        try:
            self._presses[button]()
        except ModevizError as error:
            if event.client:
                refuse(event.client, str(error))


def offered(look: SearchStatus | None, state: State) -> tuple[str, ...]:
    """The buttons that have something to do."""
    if look is None or look.found is None:
        return OFFERED.get(look.stage, (START,)) if look else (START,)
    found = look.found.rates, look.found.placements
    every = state.design.variants.values()
    is_pinned = any((variant.rates, variant.alterations.placements) == found for variant in every)
    is_present = design_of(state) == found
    accept = () if is_pinned and is_present else (ACCEPT,)
    go_back = (GO_BACK,) if is_present and not is_pinned else ()
    return (START, *accept, *go_back)


def _missing(session: Session) -> str:
    """Return why there is nothing to optimise for."""
    try:
        problems(session.vehicle)
    except VehicleError as error:
        return str(error)
    return ""
