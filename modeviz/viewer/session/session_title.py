"""What the owner of a session calls it."""

from collections.abc import Callable

from modeviz.errors import ModevizError

LONGEST = 60
"""Letters."""


class SessionTitle:
    """The title of a session, kept where that is kept."""

    def __init__(self, text: str) -> None:
        """Is kept nowhere until `keep_in` says more; "" is none."""
        self.text: str = text
        self._keep: Callable[[str], object] = lambda _: None
        self._listeners: list[Callable[[], None]] = []

    def keep_in(self, keep: Callable[[str], object]) -> None:
        """Has a new title kept by something from now on."""
        self._keep = keep

    def on_change(self, listener: Callable[[], None]) -> None:
        """Has something called, in any thread, when the title is another."""
        self._listeners.append(listener)

    def put(self, text: str) -> None:
        """Gives the session another title, or with "" none.

        Raises:
            ModevizError: it is too long, or has what is no letter.
        """
        text = " ".join(text.split())
        if len(text) > LONGEST:
            raise ModevizError(f"the title has {len(text)} letters, expected at most {LONGEST}")
        if not text.isprintable():
            raise ModevizError("the title has what cannot be printed, expected letters and signs")
        if text != self.text:
            self.text = text
            self._keep(text)
        for listener in self._listeners:
            listener()
