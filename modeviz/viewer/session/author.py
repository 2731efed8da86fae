"""Who made a change."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Author:
    """Somebody who made a change: the same one whatever the name was then."""

    name: str = field(compare=False)
    number: int = 0
    """Of the visitor in the session; 0: its owner."""

    @property
    def is_owner(self) -> bool:
        """Whether the session is this author's own."""
        return self.number == 0


OWNER = Author("Owner")
"""Of a session in which nobody has another name."""
