"""What moves on the screen: a mode, or whatever else was asked for, in generalised coordinates."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from modeviz.analysis.deflection_shapes import complex_mode, road_shape, wheel_shape
from modeviz.analysis.results import Results
from modeviz.analysis.shared_bodies import carried_over
from modeviz.dynamics.components import (
    ComponentModes,
    ComponentShare,
    component_modes,
    component_shares,
)
from modeviz.errors import SolveError
from modeviz.text.wording import sentence_case
from modeviz.vehicle.arrays import Array, Complexes
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.followed_mode import FollowedMode
from modeviz.viewer.session.state import ResponseCurve, State
from modeviz.viewer.session.static_answers import SolvedStatics


@dataclass(frozen=True, eq=False)
class Movement:
    """A shape that moves, and what there is to say of it."""

    title: str
    """What it is called, with a capital."""
    subject: str
    """The same in the name of a file: "operating shape 11.0 Hz"."""
    frequency_hz: float
    about: str
    """What else to know, short."""
    shape: Array
    """(n_dofs,), real or complex."""
    other: Array | None
    """The shape it is compared with, in the same phase and scale, if its outlines are wanted."""
    bodies: frozenset[str] | None = None
    """The only bodies to be seen; None if all are."""
    component: ComponentModes | None = None
    """Of a body alone: all its own modes."""
    shares: tuple[ComponentShare, ...] = ()
    """What these have of the mode that is followed, the largest first."""
    problem: str = ""
    """Why this is not what was asked for, but what moved before; "" if it is."""
    is_still: bool = False
    """Whether it is no motion but a place, with no frequency."""

    @property
    def heading(self) -> str:
        """What it is called, with its frequency if it has one."""
        return self.title if self.is_still else f"{self.title}, {self.frequency_hz:.2f} Hz"


def movement(state: State, shown: FollowedMode, static: SolvedStatics | None = None) -> Movement:
    """Return the motion in the answer to a state.

    Args:
        state: what is asked for.
        shown: the mode that is followed.
        static: the load cases; None where nothing asks for them.

    Raises:
        SolveError: there is no such shape, because the mode does not vibrate, the frequency is that of
            an undamped resonance, the reference does not move or nothing holds the vehicle.
    """
    match state.motion.kind:
        case "mode":
            return _undamped(state, shown)
        case "damped mode":
            return _damped(state, shown)
        case "operating shape":
            return _operating(state, shown)
        case "component":
            return _component(state, shown)
        case "sag":
            assert static is not None
            return _sag(state, shown, static)


def asks(state: State) -> tuple[object, ...]:
    """All of a state that decides what moves beyond the shown mode."""
    charts = state.charts
    return state.motion, charts.load, charts.reference, state.look.ghost == "compared"


def _undamped(state: State, shown: FollowedMode) -> Movement:
    modes, i = shown.now.modes, shown.mode
    about = f"mode {i + 1}, damping {100 * modes.damping_ratio[i]:.1f} %"
    other = _same_mode(state, shown, lambda base, same: base.modes.shapes[:, same])
    title = sentence_case(shown.name.spoken)
    return Movement(title, shown.name.name, float(modes.frequency_hz[i]), about, shown.shape, other)


def _damped(state: State, shown: FollowedMode) -> Movement:
    mode = complex_mode(shown.now, shown.mode)
    about = f"damped, {100 * mode.damping_ratio:.1f} % of critical"
    other = _same_mode(state, shown, lambda base, same: complex_mode(base, same).shape)
    title = sentence_case(shown.name.spoken)
    shape = _in_phase(mode.shape, shown)
    subject = f"{shown.name.name} damped"
    return Movement(title, subject, mode.damped_frequency_hz, about, shape, other)


def _operating(state: State, shown: FollowedMode) -> Movement:
    """The shape under road or wheel load; the phase of either is that of what excites or is read."""
    now = shown.now
    if state.charts.load:
        about = state.charts.load
    else:
        curve = _reference(state)
        point = now.prepared.vehicle.response_points[curve.point].name
        about = f"{now.conditions.road}, as at {point}, {curve.direction}"
    other = None
    if state.look.ghost == "compared":
        other = _in_coordinates_of(shown, _excited(state, shown.base))
    f, shape = state.motion.operating_hz, _excited(state, now)
    return Movement("Operating shape", f"operating shape {f:.1f} Hz", f, about, shape, other)


def _excited(state: State, results: Results) -> Complexes:
    if state.charts.load:
        return wheel_shape(results, state.charts.load, state.motion.operating_hz)
    curve = _reference(state)
    return road_shape(results, state.motion.operating_hz, curve.point, curve.direction)


def _reference(state: State) -> ResponseCurve:
    """The response in whose phase a vehicle is seen on its road."""
    reference = state.charts.reference
    if reference is None:
        raise SolveError("an operating shape on a road needs a [[road]] and a [[response_point]]")
    return reference


def _component(state: State, shown: FollowedMode) -> Movement:
    system = shown.now.prepared.system
    modes = _free_modes(system, state.motion.component)
    i = min(state.motion.component_mode, len(modes.names) - 1)
    label = sentence_case(system.vehicle.body(state.motion.component).label)
    return Movement(
        f"{label} alone: {modes.names[i]}",
        f"{label} {modes.names[i]}",
        float(modes.frequency_hz[i]),
        "free, nothing attached",
        modes.shapes[:, i],
        None,
        frozenset({state.motion.component}),
        modes,
        component_shares(system, shown.shape, state.motion.component),
    )


def _sag(state: State, shown: FollowedMode, static: SolvedStatics) -> Movement:
    """The shape in which the vehicle stands in a load case, from where it is unloaded."""
    case = static.now.case(state.motion.load_case)
    other = None
    if state.look.ghost == "compared":
        other = _in_coordinates_of(shown, static.base.case(case.name).motion)
    return Movement(
        f"Sag: {case.name}",
        f"sag {case.name}",
        0.0,
        "still, from where nothing is loaded",
        case.motion,
        other,
        is_still=True,
    )


_free_modes = lru_cache(maxsize=1)(component_modes)
"""A body's own modes, which no rate changes."""


def _same_mode(
    state: State, shown: FollowedMode, shape: Callable[[Results, int], Array]
) -> Array | None:
    """The shape of the base's mode that is compared with the shown one, if it is wanted."""
    if state.look.ghost != "compared" or shown.same is None:
        return None
    return _in_phase(_in_coordinates_of(shown, shape(shown.base, shown.same)), shown)


def _in_coordinates_of(shown: FollowedMode, shape: Array) -> Array:
    """A shape of the vehicle compared with in the coordinates of the present one."""
    return carried_over(shape, shown.base.prepared.system, shown.now.prepared.system)


def _in_phase(shape: Array, shown: FollowedMode) -> Array:
    """A shape turned to move with the shown mode as far as it can; a real one stays real."""
    product = np.vdot(shape, shown.now.prepared.system.mass @ shown.shape)
    return shape * (product / abs(product)) if product else shape


def n_free_modes(vehicle: Vehicle, body: str) -> int:
    """Return the number of free modes of a body: its rigid ones, and its elastic ones."""
    its = vehicle.body(body)
    return its.n_normal if isinstance(its, FlexibleBody) else 6
