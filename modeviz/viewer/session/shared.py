"""What sessions of a vehicle have in common."""

from dataclasses import dataclass, field, replace

from modeviz.compute.precedence import Precedence
from modeviz.viewer.session.beginnings import Beginnings
from modeviz.viewer.session.preparations import Preparations


@dataclass(frozen=True, eq=False)
class Shared:
    """What a session gets from others, and leaves to them; what has a default it has alone."""

    preparations: Preparations
    """Of the vehicle."""
    beginnings: Beginnings = field(default_factory=Beginnings)
    precedence: Precedence = field(default_factory=Precedence)
    """Says when it may do what nobody waits for."""

    def copied(self) -> "Shared":
        """Return the same with preparations that can go on without those of a solve that hangs."""
        return replace(self, preparations=self.preparations.copied())
