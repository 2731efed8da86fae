"""Right column, lower part: the modes, where each was before, and which of them is shown."""

from dataclasses import dataclass
from html import escape

import numpy as np
import viser

from modeviz.analysis.results import Results
from modeviz.dynamics.naming import ModeName
from modeviz.dynamics.tracking import WEAK_MAC
from modeviz.text.wording import sentence_case, signed
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import (
    HiddenButtons,
    block,
    heading,
    hinted,
    legend,
    named,
    row,
    span,
    table,
    title,
)
from modeviz.viewer.panels.ladder import Rail, Scale, around, ladder
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.commands.looks import ShowMode
from modeviz.viewer.session.followed_mode import FREE_HZ
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

LISTED_HZ = (FREE_HZ, 21.0)
"""Above, the ride ends."""

HELD = 0.1
"""Where mounts have this share of the strain energy, their rates move the mode."""

SAME_SHAPE = 0.8
"""A shape of which a mode holds this much needs no further word."""

N_PARTS, LEAST_PART = 3, 0.05
"""How many modes that hold a part of a shape are named, and how large a part must be."""

N_ROWS = 40
NONE_LISTED = (
    f"No mode between {LISTED_HZ[0]:g} and {LISTED_HZ[1]:g} Hz with these rates: undo the last change, "
    "or load another set."
)


class ModesPanel:
    """The ladder of frequencies and a table whose rows show their mode when clicked."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the table; `show` fills it."""
        self._names: list[str] = []
        self._rates: Rates = {}
        self._buttons = HiddenButtons(gui, N_ROWS, lambda i: self._select(session, i))
        self._content = gui.add_html("")

    def _select(self, session: Session, i: int) -> None:
        names = self._names
        if i < len(names):  # else a shorter list came between the click and here
            session.do(ShowMode(names[i], self._rates))

    def show(self, solved: Solved) -> None:
        """Lists the modes of an answer."""
        modes = listed(solved.now)
        self._names = [name.name for name, _ in modes.values()][:N_ROWS]
        self._rates = solved.now.rates
        content = block(_ladder(solved), _old_shape(solved), self._table(solved, list(modes)))
        assign(self._content, content=content)

    def _table(self, solved: Solved, modes: list[int]) -> str:
        if not modes:
            return span(NONE_LISTED, "dim")
        moved = _moves_most(solved.now)
        rows = [
            row(self._cells(i, mode, solved, moved[mode]), chosen=mode == solved.followed.mode)
            for i, mode in enumerate(modes[:N_ROWS])
        ]
        header = (
            hinted("Mode", "Click a mode to see it move; ~ marks a name that fits weakly"),
            hinted("Hz", "Natural frequency, undamped"),
            hinted("Δ Hz", f"Change against {escape(solved.state.against)}"),
            hinted("ζ %", "Damping, percent of critical"),
            hinted("moves most", "Body with most of the mode's kinetic energy, and its share"),
        )
        return table(header, rows, "modes")

    def _cells(self, i: int, mode: int, solved: Solved, moved: str) -> list[str]:
        now = solved.now
        name, f = now.names[mode], float(now.modes.frequency_hz[mode])
        return [
            self._buttons.label(i, named(sentence_case(name.spoken))),
            f"{f:.2f}",
            moved_by(solved, mode),
            f"{100 * now.modes.damping_ratio[mode]:.1f}",
            span(moved, "dim"),
        ]


def listed(results: Results) -> dict[int, tuple[ModeName, float]]:
    """The modes of the ride band by index: name and frequency."""
    return {
        i: (results.names[i], f)
        for i, f in enumerate(results.modes.frequency_hz.tolist())
        if LISTED_HZ[0] < f < LISTED_HZ[1]
    }


def moved_by(solved: Solved, mode: int) -> str:
    """Return how far a mode moved; where there is none to compare it with, a hint on its shape."""
    base, now = solved.base, solved.now
    pair = next(p for p in solved.followed.pairs if p.after == mode)
    if pair.before is None:
        return _without_partner(solved, mode)
    name, old = base.names[pair.before].name, float(base.modes.frequency_hz[pair.before])
    was = f"the {escape(name)} of {escape(solved.state.against)}, {old:.2f} Hz"
    change = float(now.modes.frequency_hz[mode]) - old
    text = span(("~" if pair.is_weak else "") + signed(change, 2), "" if change else "dim")
    if pair.is_weak:
        return hinted(text, f"Against {was}, which is alike only in part")
    return text if name == now.names[mode].name else hinted(text, f"Against {was}")


def _without_partner(solved: Solved, mode: int) -> str:
    """A dash, with what a mode's shape was as a hint."""
    sources, base = solved.followed.track.sources(mode), solved.base
    if not sources:
        return span("new", "dim")
    part = " in part" if sources[0][1] < WEAK_MAC else ""
    were = " and ".join(
        f"the {escape(base.names[i].name)} of {escape(solved.state.against)}, "
        f"{base.modes.frequency_hz[i]:.2f} Hz"
        for i, _ in sources
    )
    return hinted(span("–", "dim"), f"Nothing there moves like this; its shape was{part} {were}")


def scale(base: Results) -> Scale | None:
    """The part of the band in which the mounts hold the modes: there is something to see on a ladder.

    Of all listed modes if the mounts hold none, None if there are none. It goes by the rates compared
    with, so that it stands still while others move.
    """
    modes = listed(base)
    none = np.zeros(len(base.modes.frequency_hz))
    held = sum((base.strain_energy[group] for group in base.rates), none)
    moved = [f for i, (_, f) in modes.items() if held[i] > HELD]
    frequency_hz = moved or [f for _, f in modes.values()]
    return around(frequency_hz) if frequency_hz else None


def _ladder(solved: Solved) -> str:
    """The ladder of all modes, joined where the shapes of the modes compared with went.

    A shape that several modes share is joined to each of them.
    """
    base, now, track = solved.base, solved.now, solved.followed.track
    drawn = scale(base)
    if drawn is None:
        return ""
    old = solved.followed.same
    after = now.modes.frequency_hz.tolist()
    rails = [
        Rail(before, after[i], share < WEAK_MAC, strong=mode == old)
        for mode, before in enumerate(base.modes.frequency_hz.tolist())
        for i, share in track.holders(mode)
    ]
    drawing = ladder(_by_name(base), _by_name(now), rails, solved.followed.name.name, drawn)
    return _heading(solved, old) + drawing


def _heading(solved: Solved, old: int | None) -> str:
    """The shown mode before and now, and which colour is which."""
    f = solved.now.modes.frequency_hz[solved.followed.mode]
    was = "" if old is None else f"{solved.base.modes.frequency_hz[old]:.2f} → "
    colors = legend((("--mv-base", escape(solved.state.against)), ("--mv-now", "now")))
    return heading(f"{title(solved.followed.name.spoken)} {was}{f:.2f} Hz", colors)


def _by_name(results: Results) -> dict[str, float]:
    return {
        name.name: f for name, f in zip(results.names, results.modes.frequency_hz.tolist(), strict=True)
    }


def _old_shape(solved: Solved) -> str:
    """Return what became of the shape that the shown mode is compared with, if it is another mode."""
    old = solved.followed.same
    if old is None or solved.followed.track.shares[old, solved.followed.mode] > SAME_SHAPE:
        return ""
    modes, names = solved.now.modes, solved.now.names
    parts = [
        f"{100 * share:.0f} % {escape(names[i].spoken)} {modes.frequency_hz[i]:.2f} Hz"
        for i, share in solved.followed.track.split(old, N_PARTS)
        if share > LEAST_PART
    ]
    shape = f"The {escape(solved.base.names[old].name)} of {escape(solved.state.against)}"
    return f'<div class="dim">{shape} is now {", ".join(parts)}</div>'


def _moves_most(results: Results) -> list[str]:
    """For every mode the body with the largest share of its kinetic energy, and that share."""
    labels = {body.name: body.label for body in results.prepared.vehicle.bodies}
    bodies = [labels[name] for name in results.kinetic_energy]
    shares = np.stack(list(results.kinetic_energy.values()))
    most = shares.argmax(axis=0).tolist()
    percent = (100 * shares.max(axis=0)).tolist()
    return [named(f"{bodies[i]} {share:.0f} %") for i, share in zip(most, percent, strict=True)]


@dataclass(frozen=True, eq=False)
class StepMode(Command):
    """Shows a mode further down the list of an answer, from the one that is asked for."""

    last: Solved
    by: int

    def apply(self, state: State, vehicle: Vehicle) -> State:
        last, motion = self.last, state.motion
        modes = list(listed(last.now))
        before = last.state.motion
        is_answered = (motion.mode, motion.mode_rates) == (before.mode, before.mode_rates)
        shown = last.followed.mode if is_answered else last.now.mode_index(motion.mode)
        at = modes.index(shown) + self.by if shown in modes else 0
        name = last.now.names[modes[at % len(modes)]].name
        return ShowMode(name, last.now.rates).apply(state, vehicle)


def step_mode(session: Session, by: int) -> None:
    """Shows the mode so far down the list of the newest answer, if that lists any."""
    last = session.answer
    if last and listed(last.now):
        session.do(StepMode(last, by))
