"""What tests ask of a session, and what they hear from it."""

from dataclasses import fields, replace

from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.notifications import Answered, Checked, Failed

PARTS = ("design", "motion", "charts", "look")


class Alter(Command):
    """Puts values into fields of a state or its parts, whatever commands there are for them."""

    def __init__(self, **values):
        self._values = values

    def apply(self, state, vehicle):
        return altered(state, **self._values)


class Become(Command):
    """Puts one state in the place of another."""

    def __init__(self, state):
        self._state = state

    def apply(self, state, vehicle):
        return self._state


class AlterPlan(Command):
    """Puts values into fields of the plan."""

    def __init__(self, **values):
        self._values = values

    def apply(self, state, vehicle):
        return altered(state, plan=replace(state.design.plan, **self._values))


def altered(state, **values):
    """The state with other values in its fields or those of its parts."""
    for name, value in values.items():
        part = next((p for p in PARTS if name in [f.name for f in fields(getattr(state, p))]), None)
        if part is None:
            state = replace(state, **{name: value})
        else:
            state = replace(state, **{part: replace(getattr(state, part), **{name: value})})
    return state


class Listener:
    """Keeps what a session tells."""

    def __init__(self):
        self.answers, self.failures = [], []

    def __call__(self, notification):
        match notification:
            case Answered(solved) | Checked(solved):
                self.answers.append(solved)
            case Failed(error):
                self.failures.append(error)
