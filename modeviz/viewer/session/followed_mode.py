"""Which mode is shown, whatever rates move: the one that was chosen, followed by its name and shape."""

import time
from dataclasses import dataclass

import numpy as np

from modeviz.analysis.modal_results import ModalResults, solve_modal
from modeviz.analysis.mode_tracking import Pair, follow, pair_modes, same_mode
from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Results
from modeviz.dynamics.naming import ModeName
from modeviz.dynamics.tracking import Track
from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.viewer.session.state import State

FREE_HZ = 0.5
"""Below, something moves freely."""

SAME_MAC = 0.9
"""Of the shape shown last with so much of it a mode is shown on, until details are drawn again."""

DETAILS_EVERY = 0.1
"""s between two looks at tables while rates move; curves, figures and shape follow every move."""

DETAILS_WITHIN = 0.5
"""s for which tables do not follow at all, where others wait for answers meanwhile."""


@dataclass(frozen=True, eq=False)
class FollowedMode:
    """The mode that is followed, whatever moves, and how modes are compared."""

    now: Results
    base: Results
    """With the set of rates that all is compared with."""
    mode: int
    """Which of `now.modes`."""
    same: int | None
    """The mode of `base` that it is compared with; None if there is none."""
    name: ModeName
    """What it is called, or was when what is for reading was drawn last."""
    shape: Floats
    """(n_dofs,), in phase with the one shown before."""
    track: Track
    """Where the modes of `base` went."""
    pairs: tuple[Pair, ...]
    """The modes of `base` and of `now`, as they are compared."""
    is_detailed: bool
    """Whether what is for reading is to be drawn too; else `track` and `pairs` are of the last such."""

    def is_as(self, other: "FollowedMode") -> bool:
        """Whether the same mode is shown, and compared with the same."""
        results = self.now is other.now and self.base is other.base
        return results and (self.mode, self.same) == (other.mode, other.same)


class ModeFollower:
    """Follows the mode that a state asks for from one answer to the next."""

    def __init__(self, prepared: Prepared, before: "ModeFollower | None" = None) -> None:
        """Follows nothing yet.

        Args:
            prepared: the vehicle whose modes they are.
            before: who followed the mode in the vehicle as it was before it was altered, if any.
        """
        self._prepared, self._before = prepared, before and before.chosen
        self._last: tuple[State, FollowedMode] | None = None
        self._chosen_by: tuple[str, Rates] | None = None
        self._chosen: tuple[ModalResults, int]
        """The mode that was chosen to be shown, where it is called so."""
        self._detailed_at = -np.inf
        self._quick_since = np.inf
        """When the first answer without details came since the last one with them."""

    @property
    def chosen(self) -> tuple[str, ModalResults, int] | None:
        """What the chosen mode is called, and which it is of some results; None before the first."""
        return None if self._chosen_by is None else (self._chosen_by[0], *self._chosen)

    def follow(
        self, state: State, base: Results, now: Results, is_hurried: bool = False
    ) -> FollowedMode:
        """Return the mode to be shown.

        Args:
            state: what is asked for.
            base: the results that all is compared with.
            now: those with the rates of the state.
            is_hurried: whether others wait, so that details are left for when nothing moves.
        """
        followed = self._recognised(state, base, now, is_hurried)
        followed = followed or self._in_detail(state, base, now)
        quick_since = min(self._quick_since, time.perf_counter())
        self._quick_since = np.inf if followed.is_detailed else quick_since
        self._last = state, followed
        return followed

    def _recognised(
        self, state: State, base: Results, now: Results, is_hurried: bool
    ) -> FollowedMode | None:
        """The mode that clearly is the one shown last, while details need not be drawn; else None."""
        if self._last is None:
            return None
        before, last = self._last
        if now is last.now or self._is_due(is_hurried) or _shows_something_else(before, state):
            return None
        likeness = (now.modes.shapes.T @ now.prepared.system.mass @ last.shape) ** 2
        mode = int(likeness.argmax())
        if likeness[mode] <= SAME_MAC:
            return None
        shape = self._in_phase(now.modes.shapes[:, mode])
        return FollowedMode(now, base, mode, last.same, last.name, shape, last.track, last.pairs, False)

    def _is_due(self, is_hurried: bool) -> bool:
        """Whether it is time for details, whatever else is shown."""
        now = time.perf_counter()
        is_spared = is_hurried and now - self._quick_since < DETAILS_WITHIN
        return now - self._detailed_at >= DETAILS_EVERY and not is_spared

    def _in_detail(self, state: State, base: Results, now: Results) -> FollowedMode:
        """The mode chosen, and where all modes of the base went."""
        if self._last is None or now is not self._last[1].now:
            self._detailed_at = time.perf_counter()
        mode, track = self._mode(state, now), follow(base, now)
        pairs = pair_modes(base, now, track)
        same = next(pair.before for pair in pairs if pair.after == mode)
        shape = self._in_phase(now.modes.shapes[:, mode])
        return FollowedMode(now, base, mode, same, now.names[mode], shape, track, pairs, True)

    def _mode(self, state: State, now: Results) -> int:
        """The mode that the chosen one is compared with, else the one with most of its shape.

        Whatever was shown between: the same rates show the same mode.
        """
        chosen, mode = self._choice(state, now)
        same = same_mode(chosen, mode, now)
        return follow(chosen, now).split(mode)[0][0] if same is None else same

    def _choice(self, state: State, now: Results) -> tuple[ModalResults, int]:
        """The mode that a state asks for, where it has its name.

        If it has it nowhere, in the vehicle before it was altered; else the slowest.
        """
        wanted = state.motion.mode, state.motion.mode_rates
        if self._chosen_by != wanted:
            self._chosen_by, self._chosen = wanted, self._named(*wanted, now)
        return self._chosen

    def _named(self, name: str, rates: Rates, now: Results) -> tuple[ModalResults, int]:
        for results in (self._results_with(rates, now), now):
            mode = results.mode_index(name)
            if mode is not None:
                return results, mode
        if self._before is not None and self._before[0] == name:
            return self._before[1:]
        f = now.modes.frequency_hz
        return now, min(int(np.searchsorted(f, FREE_HZ)), len(f) - 1)

    def _results_with(self, rates: Rates, now: Results) -> ModalResults:
        """The modes with other rates, or the present ones if those have none."""
        try:
            known = self._prepared.all_rates(rates) == now.rates
            return now if known else solve_modal(self._prepared, rates)
        except SolveError:
            return now

    def _in_phase(self, shape: Floats) -> Floats:
        """The shape, turned so that it does not jump by half a cycle from the one before."""
        mass = self._prepared.system.mass
        turned = self._last is not None and self._last[1].shape @ mass @ shape < 0
        return -shape if turned else shape


def _shows_something_else(before: State, now: State) -> bool:
    """Whether more than rates changed, so that all has to be drawn."""
    return (before.motion, before.against) != (now.motion, now.against)
