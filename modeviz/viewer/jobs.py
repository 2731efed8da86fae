"""Work for one page that takes a while: a bar and a cancel button in its way until it is done."""

import threading
import traceback
from collections.abc import Callable

import viser

from modeviz.errors import ModevizError

Tell = Callable[[float], None]
"""Told the fraction that is done; raises `CancelledError` once that is wanted."""


class CancelledError(Exception):
    """Nobody wants the result any more."""


def run(client: viser.ClientHandle, title: str, work: Callable[[Tell], None]) -> None:
    """Does some work; its page shows how far it is, can cancel it, and is told what went wrong.

    Args:
        client: the page.
        title: what is being done.
        work: does it, and tells often.
    """
    window = client.gui.add_modal(title)
    with window:
        bar = client.gui.add_progress_bar(0.0, animated=True)
        cancel = client.gui.add_button("Cancel", hint="Stops at once; nothing is saved")
    is_cancelled = threading.Event()

    @cancel.on_click
    def _(_: viser.GuiEvent) -> None:
        is_cancelled.set()
        cancel.disabled = True

    def tell(fraction: float) -> None:
        if is_cancelled.is_set():
            raise CancelledError
        if fraction < 1:  # else the bar goes in the same breath, and viser's page would complain
            bar.value = 100 * fraction

    try:
        work(tell)
    except CancelledError:
        pass
    except ModevizError as error:
        client.add_notification("Not saved", str(error), color="red")
    except Exception as error:
        traceback.print_exception(error)
        client.add_notification(
            "Not saved", "This is our mistake: the terminal says more.", color="red"
        )
    finally:
        window.close()
