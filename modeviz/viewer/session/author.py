"""Who made a change, and whose changes somebody may take back: his own."""

from dataclasses import dataclass, field

from modeviz.errors import ModevizError


@dataclass(frozen=True)
class Author:
    """Somebody who makes changes: the same one whatever the name is then."""

    name: str = field(compare=False)
    id: str = ""
    """The digest of the key by which a visitor is known; empty: the owner of the session."""

    @property
    def is_owner(self) -> bool:
        """Whether the session is this author's own."""
        return not self.id


OWNER = Author("Owner")
"""Of a session in which nobody has another name."""


class NotOnesOwnError(ModevizError):
    """A change that is to be taken back or made again is somebody else's."""

    def __init__(self, author: Author, asking: Author) -> None:
        """Says whose it is, and who can go on.

        Args:
            author: of the change.
            asking: who wanted to go back over it, or forward.
        """
        others = "" if author.is_owner else " or the owner of the session"
        super().__init__(
            f"the change before this is {author.name}'s, so only {author.name}{others} can go over it"
        )
        self.author: Author = author
        self.may_insist: bool = asking.is_owner
        """Whether who asked can go over it all the same."""
