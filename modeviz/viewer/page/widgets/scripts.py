"""Scripts of ours in every page; they lean on viser's private `RunJavascriptMessage`."""

import json
from importlib.resources import files
from typing import Any

import viser
from viser import _messages


def run(api: viser.SceneApi | viser.GuiApi, path: str, *arguments: Any) -> None:
    """Calls a script in every page there is and will be; after a reconnect it is called again.

    Args:
        api: of the server.
        path: of a file in `modeviz.viewer` that is one function.
        *arguments: of that function, as JSON has them.
    """
    function = files("modeviz.viewer").joinpath(path).read_text("utf-8").rstrip()
    source = f"({function})({', '.join(map(json.dumps, arguments))});"
    api._websock_interface.queue_message(_messages.RunJavascriptMessage(source=source))


def say(client: viser.ClientHandle, source: str) -> None:
    """Runs some JavaScript in one page."""
    client._websock_connection.queue_message(_messages.RunJavascriptMessage(source))


def say_newest(client: viser.ClientHandle, about: str, source: str) -> None:
    """Runs some JavaScript in one page, in place of what it has not had yet about the same."""
    message = _messages.RunJavascriptMessage(source)
    vars(message)["redundancy_key"] = lambda: f"script {about}"
    client._websock_connection.queue_message(message)
