"""Notices on pages of what is wrong: each is there once, however often it is said."""

import viser
from viser import _messages


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


def _name(name: str) -> str:
    return f"modeviz {name}"
