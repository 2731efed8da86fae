"""What a tuning session tells: each notification is a value."""

from dataclasses import dataclass

from modeviz.viewer.session.answers import Solved


@dataclass(frozen=True, eq=False)
class Answered:
    """There is an answer to be drawn."""

    solved: Solved


@dataclass(frozen=True)
class Preparing:
    """The vehicle is altered and made ready anew, which takes a while; the last answer stays."""

    fraction: float
    """What is done of it."""


@dataclass(frozen=True, eq=False)
class Checked:
    """A check has gone on of the answer that is drawn already."""

    solved: Solved


@dataclass(frozen=True, eq=False)
class Failed:
    """There is no answer; the last good one stays."""

    error: Exception
    """A ModevizError if somebody can put it right; else our mistake."""
    is_back: bool = False
    """Whether the session went back to the last state that was answered."""


Notification = Answered | Preparing | Checked | Failed
