"""The whole page of a vehicle with its first answer, without a browser, and what stands on it."""

import re
from html import unescape

from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server

SOON = 60
"""s: within which a small vehicle is solved on a busy machine."""


def opened_app(vehicle, conditions, token="open-sesame-open"):
    server = open_server(port=0, token=token)
    app = App(vehicle, vehicle.rates, conditions, server)
    app.start()
    assert app.session.wait(SOON)
    return app


def text(html):
    """The words of an HTML widget, with a space where a tag was."""
    return unescape(re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", html.content)))
