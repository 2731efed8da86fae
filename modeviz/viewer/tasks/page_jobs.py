"""Work for one page that takes a while: a bar and a cancel button in its way until it is done."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol

import viser

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.errors import ModevizError
from modeviz.text.log import our_mistake


class Progress(Protocol):
    """Told how far work is."""

    def __call__(self, fraction: float, words: str = "") -> None:
        """Shows the fraction that is done, and words beneath it.

        Raises:
            CancelledError: nobody wants the result any more.
        """
        ...


def run(
    client: viser.ClientHandle,
    title: str,
    work: Callable[[Progress], None],
    is_there: Callable[[], bool],
    report: Callable[[Exception], str],
) -> None:
    """Does some work; its page shows how far it is, can cancel it, and is told what went wrong.

    Args:
        client: the page.
        title: what is being done.
        work: does it, and tells often.
        is_there: whether the page still is; without it the work is cancelled.
        report: told what is our mistake; gives the number under which it is logged.
    """
    window = client.gui.add_modal(title)
    with window:
        bar = client.gui.add_progress_bar(0.0, animated=True)
        beneath = client.gui.add_markdown("")
        cancel = client.gui.add_button("Cancel", hint="Stops at once; nothing is saved")
    token = CancelToken()

    @cancel.on_click
    def _(_: viser.GuiEvent) -> None:
        token.cancel()
        cancel.disabled = True

    def tell(fraction: float, words: str = "") -> None:
        if not is_there():
            token.cancel()
        token.check()
        if fraction < 1:  # else the bar goes in the same breath, and viser's page would complain
            bar.value = 100 * fraction
            if words != beneath.content:
                beneath.content = words

    try:
        work(tell)
    except CancelledError:
        pass
    except ModevizError as error:
        if is_there():
            client.add_notification("Not saved", str(error), color="red")
    except Exception as error:
        client.add_notification("Not saved", our_mistake(report(error)), color="red")
    finally:
        window.close()


@contextmanager
def turn(places: threading.Semaphore, tell: Progress) -> Iterator[None]:
    """Waits for one of a few places in which such work is done at once."""
    while not places.acquire(timeout=0.1):
        tell(0.0)
    try:
        yield
    finally:
        places.release()
