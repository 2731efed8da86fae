"""Options of commands that serve pages: where, to whom, and how they look."""

from argparse import ArgumentParser
from dataclasses import dataclass
from pathlib import Path

from modeviz.cli.logs import LogOptions, add_log

DEFAULT_PORT = 8080


@dataclass(frozen=True, kw_only=True)
class ServerOptions(LogOptions):
    """Where and to whom pages are served."""

    host: str = "127.0.0.1"
    """Address to listen on."""
    port: int = DEFAULT_PORT
    """0 takes a free one."""
    public_names: tuple[str, ...] = ()
    """Under which a proxy makes the page known."""
    frames: tuple[str, ...] = ()
    """Origins of pages that may show it in a frame."""
    proxies: tuple[str, ...] = ()
    """Addresses of those that are believed in whom they say they ask for."""
    path_prefix: str = ""
    """Before the path of every address."""
    token: str | None = None
    """Asked of every visitor; None: that of a file, of the environment, or a new one."""
    token_file: Path | None = None
    """Holds the token."""
    has_token: bool = True
    """Whether a token is asked for at all."""
    dark: bool = False
    """Whether the page is dark."""


def add_server(command: ArgumentParser) -> None:
    """Adds the options of a server."""
    command.add_argument(
        "--host", help="address to listen on, such as 0.0.0.0 for colleagues (default: this machine)"
    )
    command.add_argument("--port", type=int, help=f"default {DEFAULT_PORT}; 0 takes a free one")
    command.add_argument(
        "--public-name",
        action="append",
        metavar="NAME",
        dest="public_names",
        help="under which a proxy makes the page known, such as tool.example.com; may be repeated",
    )
    command.add_argument(
        "--allow-frame",
        action="append",
        metavar="ORIGIN",
        dest="frames",
        help="of pages that may show this one in a frame, such as https://wiki.example.com (default: "
        "none may); may be repeated",
    )
    command.add_argument(
        "--trust-proxy",
        action="append",
        metavar="ADDRESS",
        dest="proxies",
        help="of a proxy, or its network, whose X-Forwarded-For, -Host and -Proto say who asks where; "
        "may be repeated",
    )
    command.add_argument(
        "--path-prefix",
        metavar="PATH",
        help="before every address, such as /bench, behind a proxy that takes it off or leaves it",
    )
    token = command.add_mutually_exclusive_group()
    token.add_argument(
        "--token",
        help="asked of every visitor (default: that of the environment's MODEVIZ_TOKEN, or else one "
        "that is kept, see `modeviz token`); all who are on this machine can read it here",
    )
    token.add_argument("--token-file", type=Path, metavar="FILE", help="that holds the token")
    token.add_argument(
        "--no-token",
        action="store_false",
        dest="has_token",
        help="let in whoever is on this machine",
    )
    add_log(command)
    command.add_argument("--dark", action="store_true", help="dark pages")
