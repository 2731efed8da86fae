"""Left column: all sets of rates that have a name, kept, loaded and compared."""

from collections.abc import Callable
from html import escape
from typing import Literal, get_args

import viser

from modeviz.analysis.mode_tracking import same_mode
from modeviz.analysis.results import AXIS, Results
from modeviz.text.wording import sentence_case, signed
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, named, row, span, table
from modeviz.viewer.page.widgets.named_buttons import NamedButtons
from modeviz.viewer.page.widgets.question import ask
from modeviz.viewer.panels.exchange import ExchangePanel
from modeviz.viewer.panels.figures import DRIVER
from modeviz.viewer.panels.plots import set_line
from modeviz.viewer.panels.side_by_side import side_by_side
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.decisions import (
    Forget,
    Load,
    Pin,
    Rename,
    Swap,
    TakenNameError,
)
from modeviz.viewer.session.commands.looks import CompareWith, Overlay, ShowComparedGhost
from modeviz.viewer.session.cursor import has_ride
from modeviz.viewer.session.design import (
    current_set,
    known_sets,
    next_name,
    rate_sets,
    set_numbers,
)
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

N_ROWS = 24
"""So many sets can be clicked; more are listed only."""

Action = Literal["load", "overlay", "forget"]
ACTIONS: tuple[Action, ...] = get_args(Action)
LONGEST_NAME = 40
PIN, RENAME, SWAP = "Pin", "Rename", "A/B"


class VariantsPanel:
    """The table of sets, what the present rates are compared with, and their names and files."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls; `show` fills the tables."""
        self._session = session
        self._names: list[str] = []
        self._buttons = NamedButtons[tuple[str, Action]](gui, self._press)
        self._table = gui.add_html(block(span("The sets follow with the first answer.", "dim")))
        self._against = gui.add_dropdown(
            "Compare with",
            tuple(rate_sets(session.vehicle, session.state.design)),
            initial_value=session.state.against,
            hint="The grey curves and all changes are against this set",
        )
        swap = gui.add_button_group(
            "Switch",
            (SWAP,),
            hint="The set compared with becomes the present one and the other way round; key B. Rates "
            "without a name are pinned first",
        )
        swap.on_click(lambda _: session.do(Swap()))
        ghost = gui.add_checkbox(
            "Its outlines",
            session.state.look.ghost == "compared",
            hint="Outlines that move as the vehicle does with the set compared with, in the same phase",
        )
        self._bindings = [
            Binding(
                self._against,
                session,
                lambda state: state.against,
                lambda name: session.do(CompareWith(name)),
            ),
            Binding(
                ghost,
                session,
                lambda state: state.look.ghost == "compared",
                lambda drawn: session.do(ShowComparedGhost(drawn)),
            ),
        ]
        self._name = NameBox(gui, session)
        ExchangePanel(gui, session)
        self._side_by_side = gui.add_html("")

    def show(self, solved: Solved) -> None:
        """Lists the sets of an answer and how the present rates differ from the one compared with."""
        self._names = list(rate_sets(self._session.vehicle, solved.state.design))
        self._buttons.keep([(name, action) for name in self._names[:N_ROWS] for action in ACTIONS])
        assign(self._against, options=tuple(self._names))
        show_all(self._bindings)
        self._name.show()
        assign(
            self._table,
            content=block(self._listing(solved), _complaints(solved), _advice(solved.state)),
        )
        assign(self._side_by_side, content=block(side_by_side(solved)))

    def _press(self, button: tuple[str, Action]) -> None:
        name, action = button
        if name not in rate_sets(self._session.vehicle, self._session.state.design):
            return  # it was forgotten between the click and here
        if action == "load":
            self._session.do(Load(name))
        elif action == "forget":
            self._session.do(Forget(name))
        else:
            self._session.do(Overlay(name, name not in self._session.state.charts.overlaid))

    def _listing(self, solved: Solved) -> str:
        """A row for each set; the last for the present rates, if they have no name."""
        name = named(sentence_case(solved.followed.name.name))
        header = ("", "Set", "lat. g", "vert. g", f"{name} Hz", "rating", "")
        current = current_set(self._session.vehicle, solved.state.design)
        colors = set_numbers(self._session.vehicle, solved.state.design)
        rows = [
            row(self._cells(name, colors[name], solved), chosen=name == current) for name in self._names
        ]
        if current is None:
            figures = _figures(solved.now, solved)
            rows.append(row(["", span("not pinned", "dim"), *figures, ""], chosen=True))
        return f'<div class="sets">{table(header, rows)}</div>'

    def _cells(self, name: str, color: int, solved: Solved) -> list[str]:
        """The cells of the row of a set."""
        state, is_solved = solved.state, name in solved.named.results
        load = named(name, f"Load {name}")
        forget = '<span title="Forget this set; undo brings it back">×</span>'
        return [
            self._button(name, "overlay", _mark(color, name, state)) if is_solved else "",
            self._button(name, "load", load),
            *(_figures(solved.named.results[name], solved) if is_solved else ["–"] * 4),
            self._button(name, "forget", forget) if name in state.design.variants else "",
        ]

    def _button(self, name: str, action: Action, text: str) -> str:
        """A text that does something with a set."""
        button = name, action
        return self._buttons.label(button, text) if button in self._buttons else text


class NameBox:
    """A name for the present rates, and what to do with it."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the box and its buttons."""
        self._session = session
        self._suggested = self._suggestion()
        self._box = gui.add_text("Name", self._suggested, hint="What to call the present rates")
        buttons = gui.add_button_group(
            "Keep",
            (PIN, RENAME),
            hint="Pin keeps the present rates under this name; Rename gives it to the pinned set that "
            "is loaded",
        )
        buttons.on_click(lambda event: self._press(buttons.value, event))

    def show(self) -> None:
        """Suggests a name, unless somebody has typed another."""
        suggestion = self._suggestion()
        if self._box.value == self._suggested:
            assign(self._box, value=suggestion)
        self._suggested = suggestion

    def _suggestion(self) -> str:
        state = self._session.state
        return self._current(state) or next_name(state.design)

    def _current(self, state: State) -> str | None:
        """The pinned set that the present rates are, if they are one."""
        current = current_set(self._session.vehicle, state.design)
        return current if current in state.design.variants else None

    def _press(self, button: str, event: viser.GuiEvent) -> None:
        name = self._box.value.strip()
        try:
            complaint = self._keep(button, name)
        except TakenNameError as taken:
            if event.client:
                self._ask(event.client, taken)
            return
        if complaint and event.client:
            event.client.add_notification("Not kept", complaint, color="red")

    def _ask(self, client: viser.ClientHandle, taken: TakenNameError) -> None:
        """Asks whether a set is to be replaced; what is pinned then are the rates of that time."""
        do = self._session.do
        answers: dict[str, Callable[[], None]] = {
            f"Replace {taken.name}": lambda: do(Pin(taken.name, replaces=True)),
            f"Pin as {taken.free}": lambda: do(Pin(taken.free)),
        }
        text = f"There is another set called {taken.name}. Undo would bring it back."
        ask(client, f"Replace {taken.name}?", text, answers)

    def _keep(self, button: str, name: str) -> str | None:
        """Pins or renames; says why not, if so.

        Raises:
            TakenNameError: there is another set of that name.
        """
        state, vehicle = self._session.state, self._session.vehicle
        if not name:
            return "The set needs a name: type one first."
        if len(name) > LONGEST_NAME:
            return f"The name has {len(name)} letters: at most {LONGEST_NAME} fit the table."
        if name in known_sets(vehicle):
            return f"{name} is one of the vehicle's own sets: choose another name."
        if button == PIN:
            self._session.do(Pin(name))
            return None
        current = self._current(state)
        if current is None:
            return "The present rates are not pinned: load a pinned set to rename it."
        if name != current and name in state.design.variants:
            return f"There is a set called {name}: choose another name."
        self._session.do(Rename(current, name))
        return None


def _figures(results: Results, solved: Solved) -> list[str]:
    """RMS at the driver's point, the shown mode's frequency, and the change of the rating."""
    base = solved.base
    mode = _shown_mode(results, solved)
    f = "–" if mode is None else f"{results.modes.frequency_hz[mode]:.2f}"
    if not has_ride(solved.now.prepared.vehicle):
        return ["–", "–", f, "–"]
    gain = results.rating.mean_personal_rating - base.rating.mean_personal_rating
    kind = "dim" if abs(gain) < 0.005 else "good" if gain > 0 else "bad"
    rating = span("–", "dim") if results is base else span(signed(gain, 2), kind)
    lateral, vertical = (results.rms[DRIVER, AXIS[d]] for d in RIDE_DIRECTIONS)
    return [f"{lateral:.3f}", f"{vertical:.3f}", f, rating]


def _shown_mode(results: Results, solved: Solved) -> int | None:
    """Return the mode of a set of rates that is the shown one."""
    if results is solved.now:
        return solved.followed.mode
    return (
        solved.followed.same
        if results is solved.base
        else same_mode(solved.now, solved.followed.mode, results)
    )


def _mark(number: int, name: str, state: State) -> str:
    """The colour of a set's curve: filled if it is drawn."""
    if name == state.against:
        return '<i class="mark on base" title="Drawn grey: all is compared with this set"></i>'
    on, what = (
        (" on", "Drawn in the charts") if name in state.charts.overlaid else ("", "Draw in the charts")
    )
    color = set_line(name, number).color
    return f'<i class="mark{on}" style="--mark:{color}" title="{what}"></i>'


def _complaints(solved: Solved) -> str:
    """Return why sets have no figures."""
    reasons = (f"{name} has no answer: {why}." for name, why in solved.named.unsolved.items())
    return "".join(f'<div class="bad">{escape(reason)}</div>' for reason in reasons)


def _advice(state: State) -> str:
    if state.design.variants:
        return ""
    return span("No variant yet: change a rate, then pin it.", "dim")
