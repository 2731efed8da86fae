"""Whether a session is shared, and under which link."""

from typing import Protocol

from modeviz.errors import ModevizError


class Sharing(Protocol):
    """What makes the link of a review."""

    def share(self, author: str) -> str:
        """Makes the link, or gives the one there is: whole, or from the page such as "./?review=…".

        Args:
            author: who shares the session.
        """
        ...

    def stop(self) -> None:
        """Makes the link open nothing any more."""
        ...


class Share:
    """The review of one session, while there is one."""

    def __init__(self) -> None:
        """There is none, and nothing to make one."""
        self._sharing: Sharing | None = None
        self.link: str = ""
        """Of the review, if it was made since the session was opened; else ""."""
        self.is_open: bool = False
        """Whether who has the link of a review may look."""

    @property
    def is_offered(self) -> bool:
        """Whether there is something that makes a link."""
        return self._sharing is not None

    def offer(self, sharing: Sharing, is_open: bool) -> None:
        """Makes links by something from now on; `is_open` where somebody has one that still counts."""
        self._sharing, self.is_open = sharing, is_open

    def start(self, author: str) -> str:
        """Lets in who has the link, and gives it.

        Args:
            author: who shares the session.

        Raises:
            ModevizError: nothing is offered to share.
        """
        if self._sharing is None:
            raise ModevizError("this page cannot be shared")
        self.link, self.is_open = self._sharing.share(author), True
        return self.link

    def stop(self) -> None:
        """Lets no more in."""
        if self._sharing is not None:
            self._sharing.stop()
        self.link, self.is_open = "", False
