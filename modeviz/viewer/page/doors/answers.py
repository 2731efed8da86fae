"""Answers of few words."""

import http

from websockets import Headers
from websockets.http11 import Response


def answer(status: int, text: str = "", **headers: str) -> Response:
    """Return an answer of few words."""
    body = text.encode()
    common = {
        "Content-Type": "text/plain; charset=utf-8",
        "Content-Length": str(len(body)),
        "Connection": "close",
        "Referrer-Policy": "no-referrer",
    }
    return Response(status, http.HTTPStatus(status).phrase, Headers({**common, **headers}), body)
