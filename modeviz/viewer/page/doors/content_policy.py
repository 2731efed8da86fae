"""What a page may do, and who may show it in a frame, as browsers are told."""

from modeviz.viewer.page.doors.origins import LOOPBACK
from modeviz.viewer.page.doors.surroundings import Surroundings

ANCESTORS = " ".join(
    [
        "'self'",
        *(f"{scheme}://{name}:*" for scheme in ("http", "https") for name in LOOPBACK[:2]),
        "vscode-webview:",
        "vscode-file:",
    ]
)
"""Where notebooks are shown, as Content-Security-Policy names them: at our own address, through their
server, or on this machine. VS Code shows them in a page of its own in one of its window."""


def content_policy(host: str, around: Surroundings, is_framed: bool) -> str:
    """Return the Content-Security-Policy of a page.

    Args:
        host: under which it was asked for.
        around: the server.
        is_framed: whether notebooks may show it.
    """
    hosts = [host, *(f"{name}:*" for name in around.public_names)]
    sockets = " ".join(f"ws://{host} wss://{host}" for host in hosts)
    frames = (*((ANCESTORS,) if is_framed else ()), *around.frames)
    ancestors = " ".join(frames) or "'none'"
    return (
        f"frame-ancestors {ancestors}; connect-src 'self' {sockets} data: blob:; "
        "object-src 'none'; base-uri 'none'"
    )
