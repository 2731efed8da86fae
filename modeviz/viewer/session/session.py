"""A tuning session: what is asked for, and how that is answered. Nothing of the screen."""

from collections.abc import Callable, Sequence

from modeviz.analysis.preparation import Prepared
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.answer_loop import AnswerLoop
from modeviz.viewer.session.answers import Answers, Solved
from modeviz.viewer.session.asked import Asked
from modeviz.viewer.session.author import OWNER, Author
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.history import Accepted, Step
from modeviz.viewer.session.notifications import Notification
from modeviz.viewer.session.parts import Parts
from modeviz.viewer.session.preparations import Preparations
from modeviz.viewer.session.shared import Shared
from modeviz.viewer.session.state import State

SOLVES_WITHIN = 60.0
"""s: what takes longer hangs, as answers come in milliseconds."""


class Session:
    """Takes commands, keeps the newest state and its answer, and tells both on.

    Every answer is told in one thread, never two at once.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        state: State,
        notify: Callable[[Notification], None],
        patience: float = SOLVES_WITHIN,
        past: Sequence[Step] = (),
        future: Sequence[Step] = (),
        shared: Shared | None = None,
        acting: Callable[[], Author] = lambda: OWNER,
    ) -> None:
        """Nothing is solved before `start`.

        Args:
            vehicle: with the rates that are called the original ones.
            state: what to show first.
            notify: told of every answer and failure; what it raises is our mistake.
            patience: s that a solve may take.
            past: what can be undone, the next one last.
            future: what can be redone, the next one last.
            shared: what other sessions of the vehicle have in common with it, if there are any.
            acting: says who asks for what is done, in the thread in which it is.

        Raises:
            VehicleError: it cannot have the absorbers of the state.
        """
        shared = shared or Shared(Preparations(vehicle))
        self._parts = Parts(shared.preparations.vehicle, state.design.alterations.absorbers)
        self._asked = Asked(state, self._parts, acting, past, future)
        answers = Answers(shared, self._parts.of(state))
        self._loop = AnswerLoop(self._asked, answers, shared, notify, patience)

    @property
    def vehicle(self) -> Vehicle:
        """With the rates that are called the original ones, altered as in the newest answer."""
        return self._loop.answers.vehicle

    @property
    def original(self) -> Vehicle:
        """As in its file."""
        return self._loop.answers.original

    @property
    def prepared(self) -> Prepared:
        """The vehicle made ready; there is none before `start`."""
        return self._loop.answers.prepared

    @property
    def state(self) -> State:
        """What is asked for."""
        return self._asked.state

    @property
    def answer(self) -> Solved | None:
        """The newest answer, once there is one."""
        return self._loop.answer

    @property
    def is_stuck(self) -> bool:
        """Whether it goes on only once a solve ends that hangs."""
        return self._loop.is_stuck

    @property
    def can_undo(self) -> bool:
        return self._asked.can_undo

    @property
    def can_redo(self) -> bool:
        return self._asked.can_redo

    def start(self, progress: Callable[[float], None] | None = None) -> None:
        """Prepares the vehicle, solves with its named sets of rates and asks for the first answer.

        Args:
            progress: told the fraction of the preparation that is done.

        Raises:
            ModevizError: there is no answer on that road at that speed.
        """
        self._loop.start(progress)

    def do(self, command: Command) -> None:
        """Asks for what a command makes of the newest state; returns at once.

        Raises:
            VehicleError: it asks for what the vehicle does not have.
        """
        self._asked.do(command)
        self._loop.ask()

    def undo(self, insists: bool = False) -> None:
        """Goes back to what was decided before the last change.

        Args:
            insists: whether to go back over somebody else's, too, which the owner may.

        Raises:
            NotOnesOwnError: the last change is not one's own.
        """
        if self._asked.undo(insists):
            self._loop.ask()

    def redo(self, insists: bool = False) -> None:
        """Takes the last undoing back; as `undo`."""
        if self._asked.redo(insists):
            self._loop.ask()

    def draw_again(self) -> None:
        """Asks for the present state once more: something else is to be drawn with it."""
        self._loop.ask()

    def with_parts_of(self, state: State) -> Vehicle:
        """Return the vehicle with the parts that a state adds, and its mounts as they were given.

        Raises:
            VehicleError: it cannot have them.
        """
        return self._parts.of(state)

    def watch(self, watcher: Callable[[Accepted], None]) -> None:
        """Has somebody told of all that is accepted from now on.

        Args:
            watcher: called in the thread that asked for it, before it is answered; the session waits.
        """
        self._asked.watch(watcher)

    def wait(self, timeout: float) -> bool:
        """Waits until the newest state is answered in detail; whether that came within `timeout` s."""
        return self._loop.wait(timeout)

    def wait_checked(self, timeout: float) -> bool:
        """Waits until the newest answer is checked; whether that came within `timeout` seconds."""
        return self._loop.wait_checked(timeout)

    def wait_for_answer(self, timeout: float) -> Solved:
        """Waits for the answer to what is asked for, and gives it once it was told.

        Args:
            timeout: how long to wait, s.

        Raises:
            ModevizError: there is no such answer, or not in time.
        """
        return self._loop.wait_for_answer(timeout)

    def close(self) -> None:
        """Ends the session's threads."""
        self._loop.close()
