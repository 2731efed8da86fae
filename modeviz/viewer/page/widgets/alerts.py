"""Notices on pages: of what is wrong, each there once however often it is said, and of refusals."""

import viser
from viser import _messages

READ_WITHIN = 8.0
"""s: how long the word on a refused value stays."""


def alert(client: viser.ClientHandle, name: str, title: str, text: str) -> None:
    """Shows a notice on a page; one of the same name that is still there says this instead."""
    props = _messages.NotificationProps(
        title=title,
        body=text,
        loading=False,
        with_close_button=True,
        auto_close_seconds=None,
        color="red",
    )
    for message in (_messages.NotificationShowMessage, _messages.NotificationUpdateMessage):
        client._websock_connection.queue_message(message(_name(name), props))


def withdraw(client: viser.ClientHandle, name: str) -> None:
    """Takes a notice off a page, if it is there."""
    client._websock_connection.queue_message(_messages.RemoveNotificationMessage(_name(name)))


def refuse(client: viser.ClientHandle, why: str, is_passing: bool = False) -> None:
    """Says on a page why what it asked for is not done.

    Args:
        client: the page.
        why: in words.
        is_passing: whether it is gone soon, as of values that are moved on.
    """
    seconds = READ_WITHIN if is_passing else None
    client.add_notification("Not possible", why, color="red", auto_close_seconds=seconds)


def _name(name: str) -> str:
    return f"modeviz {name}"
