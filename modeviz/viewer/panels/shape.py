"""The floating card's second tab: what moves, a mode or something else."""

from html import escape

import viser

from modeviz.dynamics.components import ComponentModes, ComponentShare
from modeviz.ride.participation import peak_lines
from modeviz.text.axes import shown_hz
from modeviz.text.wording import told_apart
from modeviz.vehicle.absorbers import carrying_bodies
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import (
    HiddenButtons,
    block,
    heading,
    hinted,
    row,
    span,
    table,
    title,
)
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.panels.color_scale import color_scale_text
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.coloring import color_scale
from modeviz.viewer.session.commands.looks import ChangeMotion
from modeviz.viewer.session.movement import n_free_modes
from modeviz.viewer.session.responses import Responses
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import MotionKind, State
from modeviz.viewer.session.wheel_responses import NOW

MOTIONS: dict[str, MotionKind] = {
    "Mode": "mode",
    "Mode with damping": "damped mode",
    "Shape at a frequency": "operating shape",
    "One body alone": "component",
    "Sag under a load": "sag",
}
HZ_STEP = 0.05
N_PEAKS, N_SHARES = 4, 4


class ShapePanel:
    """Chooses what moves, and at which frequency or which body alone."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls; `show` fills in what is known of the answer."""
        self._session = session
        self._motion = gui.add_dropdown(
            "Shows",
            tuple(MOTIONS),
            initial_value=_motion_label(session.state.motion.kind),
            hint="A mode without or with its damping, the shape in which road or wheel load move "
            "everything at one frequency, one body without all others, or how it stands under a load",
        )
        write_back = WriteBack()
        self._frequency = gui.add_slider(
            "Frequency",
            *shown_hz(session.vehicle.highest_frequency),
            HZ_STEP,
            session.state.motion.operating_hz,
            marks=(),
            hint="Of the shape, Hz, excited by what the Response tab says",
        )
        self._peaks = gui.add_button_group("Peaks", ("–",), hint="Where the first chart peaks, Hz")
        self._peaks_hz: dict[str, float] = {}
        self._peaks.on_click(lambda _: self._to_peak(self._peaks.value))
        bodies = told_apart(carrying_bodies(session.vehicle))
        labels = {name: label for label, name in bodies.items()}
        self._body = gui.add_dropdown(
            "Body",
            tuple(bodies),
            initial_value=labels[session.state.motion.component],
            hint="Which body is seen alone, held by nothing",
        )
        self._number = gui.add_slider(
            "Its mode",
            1,
            n_free_modes(session.vehicle, session.state.motion.component),
            1,
            own_mode(session.vehicle, session.state) + 1,
            marks=(),
            hint="The first six are rigid, then by rising frequency",
        )
        self._shares: tuple[ComponentShare, ...] = ()
        self._buttons = HiddenButtons(gui, N_SHARES, self._to_share)
        self._content = gui.add_html("")
        self._scale = gui.add_html("")
        self._bindings = (
            Binding(
                self._motion,
                session,
                lambda state: _motion_label(state.motion.kind),
                lambda label: session.do(ChangeMotion(kind=MOTIONS[label])),
            ),
            Binding(
                self._frequency,
                session,
                lambda state: state.motion.operating_hz,
                lambda f: session.do(ChangeMotion(operating_hz=float(f))),
                write_back,
            ),
            Binding(
                self._body,
                session,
                lambda state: labels[state.motion.component],
                lambda label: self._to_body(bodies[label]),
            ),
            Binding(
                self._number,
                session,
                lambda state: own_mode(session.vehicle, state) + 1,
                lambda number: session.do(ChangeMotion(component_mode=int(number) - 1)),
                write_back,
            ),
        )

    def show(self, solved: Solved) -> None:
        """Draws an answer: the controls of what moves, its peaks or what makes it up."""
        state = solved.state
        is_operating, is_alone = (
            state.motion.kind == "operating shape",
            state.motion.kind == "component",
        )
        assign(self._number, max=n_free_modes(self._session.vehicle, state.motion.component))
        show_all(self._bindings)
        assign(self._frequency, visible=is_operating)
        assign(self._body, visible=is_alone)
        assign(self._number, visible=is_alone)
        assign(self._scale, content=block(color_scale_text(color_scale(solved))))
        if not solved.is_detailed:
            return
        self._peaks_hz = _peaks(solved) if is_operating else {}
        assign(self._peaks, visible=bool(self._peaks_hz))
        if self._peaks_hz:
            assign(self._peaks, options=tuple(self._peaks_hz))
        assign(self._content, content=self._about(solved), visible=not is_operating)

    def _about(self, solved: Solved) -> str:
        moving = solved.movement
        self._shares = moving.shares[:N_SHARES]
        if moving.component is None:
            return block(span(ABOUT[solved.state.motion.kind], "dim"))
        label = escape(solved.now.prepared.vehicle.body(solved.state.motion.component).label)
        total = sum(share.share for share in moving.shares)
        own = own_mode(solved.now.prepared.vehicle, solved.state)
        rows = [
            row(self._share(i, share, moving.component), chosen=share.mode == own)
            for i, share in enumerate(self._shares)
        ]
        return block(
            heading(
                f"{title(label)} in {escape(solved.followed.name.spoken)}",
                hinted(f"{100 * total:.0f} % of its energy", "Kinetic energy of the whole vehicle"),
            ),
            table((), rows, "energy"),
        )

    def _share(self, i: int, share: ComponentShare, modes: ComponentModes) -> list[str]:
        """Return a row on one of the body's modes in the vehicle's; a click shows it alone."""
        name, hertz = title(share.name), ""
        if share.mode is not None:
            name = self._buttons.label(i, name)
            hertz = (
                f"{modes.frequency_hz[share.mode]:.1f} Hz"
                if modes.frequency_hz[share.mode]
                else "rigid"
            )
        bar = f'<i style="width:{100 * share.share:.1f}%;background:var(--mv-now)"></i>'
        percent = f"{100 * share.share:.1f} %"
        return [name, span(hertz, "dim"), f'<div class="bar">{bar}</div>', percent]

    def _to_share(self, i: int) -> None:
        if i < len(self._shares) and (mode := self._shares[i].mode) is not None:
            self._session.do(ChangeMotion(component_mode=mode))

    def _to_peak(self, text: str) -> None:
        if text in self._peaks_hz:  # else the peaks moved between the click and here
            self._session.do(ChangeMotion(operating_hz=self._peaks_hz[text]))

    def _to_body(self, name: str) -> None:
        """Shows a body in its first elastic mode, or a rigid one in its first."""
        body = self._session.vehicle.body(name)
        first = body.n_rigid if isinstance(body, FlexibleBody) else 0
        self._session.do(ChangeMotion(component=name, component_mode=first))


ABOUT: dict[MotionKind, str] = {
    "mode": "All points pass their middle at once. N and P go to the next mode and the one before.",
    "damped mode": "Damping lets some points lag behind others: the motion travels.",
    "operating shape": "",
    "component": "",
    "sag": "Nothing moves: this is where the vehicle stands in the load case that the Static tab says, "
    "exaggerated. Outlines at rest are where it is unloaded.",
}


def own_mode(vehicle: Vehicle, state: State) -> int:
    """Return the own mode that a body alone shows: the one asked for, or the last it has."""
    return min(state.motion.component_mode, n_free_modes(vehicle, state.motion.component) - 1)


def _motion_label(motion: MotionKind) -> str:
    return next(label for label, m in MOTIONS.items() if m == motion)


def _peaks(solved: Solved) -> dict[str, float]:
    """The highest peaks of what the first chart draws, by rising frequency: Hz by their text."""
    if not solved.state.charts.curves:
        return {}
    f, level = _first_response(solved)
    low, high = shown_hz(solved.now.prepared.vehicle.highest_frequency)
    inside = [i for i in peak_lines(level) if low <= f[i] <= high]
    highest = sorted(sorted(inside, key=lambda i: -level[i])[:N_PEAKS])
    return {f"{f[i]:.1f}": float(f[i]) for i in highest}


def _first_response(solved: Solved) -> tuple[Floats, Floats]:
    """Frequencies and the power of the response in the first chart there, (n_freqs,) both."""
    responses, curve = Responses(solved), solved.state.charts.curves[0]
    return responses.lines(NOW), responses.power(NOW, curve)
