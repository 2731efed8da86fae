"""The end of a program that serves until it is told to stop."""

import threading
from collections.abc import Callable


class Stop:
    """Told once, from anywhere, that a program is to end."""

    def __init__(self) -> None:
        """Nobody has told yet."""
        self._told = threading.Event()

    @property
    def is_told(self) -> bool:
        return self._told.is_set()

    def tell(self) -> None:
        """Has whoever waits go on to the end."""
        self._told.set()

    def wait(self, beside: Callable[[], None] | None = None) -> None:
        """Waits until it is told, at once even while something that takes long is being done beside.

        Args:
            beside: done in a thread of its own, which is not waited for at the end.

        Raises:
            Exception: whatever `beside` raised, as soon as it does.
        """
        failures: list[Exception] = []

        def do() -> None:
            try:
                if beside:
                    beside()
            except Exception as error:
                failures.append(error)
                self.tell()

        threading.Thread(target=do, name="beside", daemon=True).start()
        self._told.wait()
        if failures:
            raise failures[0]
