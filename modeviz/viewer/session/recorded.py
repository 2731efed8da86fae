"""A session as a study file has it, opened with the vehicle as it is now."""

from collections.abc import Callable
from functools import cache

from modeviz.errors import ModevizError, listed
from modeviz.journal import changes
from modeviz.journal.fingerprint import fingerprint_of
from modeviz.journal.records import Records
from modeviz.journal.sessions import SessionId
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.author import Author
from modeviz.viewer.session.encoding.fit_design import outside_bounds
from modeviz.viewer.session.encoding.fitting import fitted
from modeviz.viewer.session.encoding.text import value_of_text
from modeviz.viewer.session.opening import Opening
from modeviz.viewer.session.state import State
from modeviz.viewer.session.view import PageView

WHAT = "session"


def recorded(
    study: Records, name: SessionId, usual: State, vehicle: Vehicle, fingerprint: str
) -> Opening | None:
    """Return a session as it was left, with what can be undone and redone; None if there is none.

    Of a vehicle that has changed since, what still fits is taken, and the rest is said.

    Args:
        study: that may have it.
        name: under which the study knows it.
        usual: the first state of the vehicle, for what does not fit.
        vehicle: as in its files.
        fingerprint: of that.

    Raises:
        ModevizError: the study cannot be read, or is damaged.
    """
    stored = study.restore(name)
    if stored is None or stored.state is None:
        return None
    found = fitted(value_of_text(stored.state, State, WHAT), usual, vehicle)
    told = found.remarks
    if stored.vehicle.digest != fingerprint:
        parts = listed(fingerprint_of(vehicle).changed_since(stored.vehicle))
        has_changed = f"vehicle {vehicle.name!r} has changed since this session was left: {parts}"
        told = (has_changed, *told, *outside_bounds(found.state.design, vehicle))

    @cache
    def state_of(text: str) -> State:
        return fitted(value_of_text(text, State, WHAT), usual, vehicle).state

    past, future = (
        tuple(_Recalled(step, state_of) for step in steps) for steps in (stored.past, stored.future)
    )
    view = _view(stored.view)
    return Opening(
        found.state,
        past,
        future,
        view.animation,
        view.camera,
        stored.title,
        study.runs(name),
        remarks=told,
    )


def _view(text: str) -> PageView:
    """How pages showed a session, or the usual if nobody said so or that cannot be read."""
    try:
        return value_of_text(text, PageView, WHAT) if text else PageView()
    except ModevizError:
        return PageView()


class _Recalled:
    """A step of before, whose states are read when somebody goes back over it: there are hundreds."""

    def __init__(self, step: changes.Step, state_of: Callable[[str], State]) -> None:
        self._step, self._state_of = step, state_of
        self.author: Author = Author(step.author, step.maker)

    @property
    def before(self) -> State:
        return self._state_of(self._step.before)

    @property
    def after(self) -> State:
        return self._state_of(self._step.after)
