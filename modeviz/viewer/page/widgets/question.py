"""A question in the way of one page, which others do not see."""

from collections.abc import Callable, Mapping
from functools import partial
from html import escape

import viser

from modeviz.errors import ModevizError
from modeviz.viewer.page.people.looking import leave_to_control
from modeviz.viewer.page.widgets.alerts import refuse
from modeviz.viewer.page.widgets.handles import GuiModalHandle
from modeviz.viewer.page.widgets.html import block

LEAVE = "Leave it as it is"


def ask(
    client: viser.ClientHandle, title: str, text: str, answers: Mapping[str, Callable[[], None]]
) -> None:
    """Asks what is to be done; nothing is until somebody answers who is still in control.

    Args:
        client: the page that is asked.
        title: of the question.
        text: likewise, plain.
        answers: what to do, by the words on its button; what raises ModevizError is told the page.
    """
    window = client.gui.add_modal(title)
    with window:
        client.gui.add_html(block(f'<p class="topic">{escape(text)}</p>'))
        client.gui.add_button(LEAVE, color="gray").on_click(lambda _: window.close())
        for words, do in answers.items():
            button = client.gui.add_button(words)
            leave_to_control(button)
            button.on_click(partial(_answer, client, window, do))


def _answer(
    client: viser.ClientHandle, window: GuiModalHandle, do: Callable[[], None], _: viser.GuiEvent
) -> None:
    window.close()
    try:
        do()
    except ModevizError as error:
        refuse(client, str(error))
