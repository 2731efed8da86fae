"""The link of a review: made, and ended, by whoever has a session."""

from collections.abc import Callable

from modeviz.journal.sessions import SessionId
from modeviz.viewer.serving.bench import Bench


class Review:
    """Lets others look at a session."""

    def __init__(self, bench: Bench, session: SessionId, address: Callable[[str], str]) -> None:
        """Makes no link yet.

        Args:
            bench: that has the session.
            session: which.
            address: makes of a key what an address says of the review.
        """
        self._bench, self._session, self._address = bench, session, address
        self._link = ""

    def share(self, author: str) -> str:
        """Return the link, from the page, that somebody gives out."""
        if not self._link:
            self._link = f"./?{self._address(self._bench.share(self._session, author))}"
        return self._link

    def stop(self) -> None:
        """Makes that link, and all there were before, open nothing any more."""
        self._link = ""
        self._bench.end_reviews(self._session)
