"""Right column: sag, static forces and travel in a load case."""

from collections.abc import Iterator, Mapping
from html import escape

import numpy as np
import viser

from modeviz.mounting.statics import Carried, StaticCase, Statics
from modeviz.mounting.travel import Travel, travels
from modeviz.text.wording import number, sentence_case
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import GROUND, Connection, Mount
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import (
    block,
    heading,
    hinted,
    named,
    row,
    span,
    table,
)
from modeviz.viewer.page.widgets.named_buttons import NamedButtons
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import ChangeMotion, SelectGroup
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State
from modeviz.viewer.session.static_answers import StaticAnswer

ABOUT_MOUNTS = (
    "Along each mount's own axes: the force on its first body, and how far that body has gone from the "
    "second, from where nothing is loaded"
)


WIDE_MM = 10.0
"""Where bodies go farther, hundredths of a millimetre are too many figures for a column."""


class StaticPanel:
    """Chooses a load case, and tells how the vehicle stands in it."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls; `show` fills in the answer."""
        self._session = session
        self._labels: Mapping[str, str] = {}
        self._mounts: Mapping[str, str] = {}
        names = [case.name for case in session.vehicle.static_cases]
        self._case = gui.add_dropdown(
            "Load case",
            tuple(names),
            initial_value=session.state.motion.load_case,
            hint="What presses on the vehicle while it stands still: the [[load_case]] tables of its "
            "vehicle.toml, or the usual ones",
        )
        self._drawn = gui.add_checkbox(
            "Draw sag",
            session.state.motion.kind == "sag",
            hint="The scene stands still as it sags, larger than it is; without the tick modes move",
        )
        self._bindings = (
            Binding(
                self._case,
                session,
                lambda state: state.motion.load_case,
                lambda name: session.do(ChangeMotion(load_case=name)),
            ),
            Binding(
                self._drawn,
                session,
                lambda state: state.motion.kind == "sag",
                lambda drawn: session.do(ChangeMotion(kind="sag" if drawn else "mode")),
            ),
        )
        self._buttons = NamedButtons[str](gui, self._select)
        self._scale = gui.add_html("", visible=False)
        self._content = gui.add_html(block(span("Sag follows with the first answer.", "dim")))

    def show(self, solved: Solved) -> None:
        """Draws the load case of an answer."""
        show_all(self._bindings)
        vehicle = solved.now.prepared.vehicle
        self._labels = {body.name: body.label for body in vehicle.bodies}
        self._mounts = {mount.name: mount.group for mount in vehicle.mounts}
        self._buttons.keep(self._mounts.values())
        assign(self._content, content=block(*self._lines(solved.static.now, solved.state)))

    def _select(self, group: str) -> None:
        self._session.do(SelectGroup(group))

    def tell_scale(self, solved: Solved, scale: float) -> None:
        """Says how many times as large as it is what is drawn stands there, if that is sag."""
        is_drawn = solved.movement.is_still and scale > 0
        if is_drawn:
            words = f"Drawn {two_figures(scale)} times as large as it is, at an amplitude of 1."
            assign(self._scale, content=block(span(words, "dim")))
        assign(self._scale, visible=is_drawn)

    def _lines(self, answer: StaticAnswer, state: State) -> Iterator[str]:
        """The page text of a load case: what is wrong with it, and its tables."""
        statics = answer.statics
        if statics is None:
            yield span(escape(sentence_case(answer.problem)), "bad")
            return
        wanted = state.motion.load_case
        refused = {refused.name: refused.reason for refused in statics.refused}
        if wanted in refused:
            yield span(escape(sentence_case(refused[wanted])), "bad")
            return
        case = statics.case(wanted)
        for note in case.notes:
            yield f'<div class="note">{escape(sentence_case(note))}</div>'
        yield from self._mounts_of(statics, case, state)
        yield heading("Bodies", "centres of gravity, from where nothing is loaded")
        largest = 1e3 * max(float(np.abs(motion[:3]).max()) for motion in case.bodies.values())
        decimals = 1 if largest >= WIDE_MM else 2
        rows = [self._body(name, motion, decimals) for name, motion in case.bodies.items()]
        yield table(("", "x mm", "y mm", "z mm", "rx °", "ry °", "rz °"), rows, "statics")
        if grounded := _on_the_ground(case):
            yield heading("Others on the ground", "along the vehicle's axes")
            yield table(("", "x N", "y N", "z N"), grounded, "statics")

    def _mounts_of(self, statics: Statics, case: StaticCase, state: State) -> Iterator[str]:
        if not self._mounts:
            return
        yield heading("Mounts", hinted("along their axes", ABOUT_MOUNTS))
        rows = [
            row(self._mount(group, case.connections[name]), chosen=group == state.group)
            for name, group in self._mounts.items()
        ]
        yield table(("", "x N", "y N", "z N", "x mm", "y mm", "z mm"), rows, "statics")
        if limited := list(travels(statics, case)):
            yield heading("Travel", "what is left of it")
            header = ("", "mm", "from", "to", "left mm")
            yield table(header, [row(_travel(travel)) for travel in limited], "statics")

    def _mount(self, group: str, carried: Carried) -> list[str]:
        forces = [number(float(force), 0) for force in carried.force[:3]]
        deflections = [number(float(d), 2) for d in 1e3 * carried.deflection[:3]]
        return [self._buttons.label(group, named(carried.connection.name)), *forces, *deflections]

    def _body(self, name: str, motion: Floats, decimals: int) -> str:
        """The row of a body: millimetres with so many decimals, and degrees."""
        millimetres = [number(float(value), decimals) for value in 1e3 * motion[:3]]
        degrees = [number(float(value), 2) for value in np.degrees(motion[3:])]
        return row([named(sentence_case(self._labels[name])), *millimetres, *degrees])


def two_figures(scale: float) -> str:
    """Return a factor as one says it: 0.25, 3.2, 18, 1400."""
    return f"{float(f'{scale:.2g}'):g}"


def _travel(travel: Travel) -> list[str]:
    """The cells of a mount's travel; what has failed stands out."""
    kind, word = ("good", "passed") if travel.passed else ("bad", "failed")
    values = [number(1e3 * v, 2) for v in (travel.deflection, travel.least, travel.most)]
    margin = hinted(span(number(1e3 * travel.margin, 2), kind), f"{word}: to the nearer limit")
    return [named(f"{travel.mount} {travel.direction}"), *values, f"{margin} {span(word, kind)}"]


def _on_the_ground(case: StaticCase) -> list[str]:
    """A row for each connection but mounts that holds on to the ground, and their sum."""
    every = [c for c in case.connections.values() if _is_grounded(c.connection) and c.force.any()]
    if not every:
        return []
    rows = [row([named(c.connection.name), *_newtons(c.vehicle_force)]) for c in every]
    total = np.sum([c.vehicle_force for c in every], axis=0)
    return [*rows, row([span("sum", "dim"), *_newtons(total)])] if len(every) > 1 else rows


def _is_grounded(connection: Connection) -> bool:
    return connection.bodies[1] == GROUND and not isinstance(connection, Mount)


def _newtons(force: Floats) -> list[str]:
    return [number(float(value), 0) for value in force[:3]]
