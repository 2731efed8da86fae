"""What moves on the screen: a mode, or whatever else was asked for, in generalised coordinates."""

from dataclasses import dataclass

from numpy.typing import NDArray

from modeviz.dynamics.naming import ModeName
from modeviz.export.wording import sentence_case
from modeviz.tuning.results import Results
from modeviz.vehicle.arrays import Floats
from modeviz.viewer.state import State


@dataclass(frozen=True, eq=False)
class Movement:
    """A shape that moves, and what there is to say of it."""

    title: str
    """What it is called, with a capital."""
    frequency_hz: float
    about: str
    """What else to know, short."""
    shape: NDArray
    """(n_dofs,), real or complex."""
    other: NDArray | None
    """The shape it is compared with, in the same phase and scale, if its outlines are wanted."""


def movement(
    state: State, now: Results, mode: int, shape: Floats, name: ModeName, base: Results
) -> Movement:
    """What moves in the answer to a state.

    Args:
        state: what is asked for.
        now: its results.
        mode: the shown mode, an index of `now.modes`.
        shape: of that mode, (n_dofs,), in the phase it is shown in.
        name: of that mode.
        base: the results compared with.
    """
    about = f"mode {mode + 1}, damping {100 * now.modes.damping_ratio[mode]:.1f} %"
    other = _same_mode(base, name, shape) if state.ghost == "compared" else None
    frequency_hz = float(now.modes.frequency_hz[mode])
    return Movement(sentence_case(name.spoken), frequency_hz, about, shape, other)


def _same_mode(base: Results, name: ModeName, shape: Floats) -> Floats | None:
    """The shape of the base's mode of that name, turned to move with another; None if it has none."""
    mode = base.mode_index(name.name)
    if mode is None:
        return None
    other = base.modes.shapes[:, mode]
    return -other if other @ base.prepared.system.mass @ shape < 0 else other
