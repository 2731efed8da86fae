"""The first page of a server of several vehicles: what there is, and what this browser left."""

from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files

from modeviz.viewer.page.doors.door import ICON


@dataclass(frozen=True)
class Left:
    """A session that a browser left."""

    title: str
    about: str
    address: str
    picture: str
    """The address of one."""


@dataclass(frozen=True)
class Shown:
    """A vehicle on the start page."""

    name: str
    about: str
    address: str
    new: str
    """The address of a new session."""
    picture: str
    """The address of one."""
    left: Sequence[Left]
    """The sessions that this browser left, the last one first."""


def start_page(vehicles: Sequence[Shown], dark: bool) -> str:
    """Return the page, which needs no script and nothing from elsewhere."""
    return _file("start_page.html").format(
        theme="dark" if dark else "light",
        title="modeviz",
        icon=b64encode(ICON.encode()).decode(),
        style=_file("start_page.css"),
        count=f"{len(vehicles)} vehicle{'s' * (len(vehicles) != 1)}",
        vehicles="".join(map(_card, vehicles)),
    )


def _card(vehicle: Shown) -> str:
    name, address = escape(vehicle.name), escape(vehicle.address)
    left = "".join(map(_line, vehicle.left))
    sessions = f"<h3>You left</h3><ul>{left}</ul>" if left else ""
    word = "Go on" if vehicle.left else "Open"
    return (
        f'<article><a class="picture" href="{address}" tabindex="-1" aria-hidden="true">'
        f'<img src="{escape(vehicle.picture)}" alt=""></a>'
        f'<div class="about"><h2><a href="{address}">{name}</a></h2>'
        f'<p class="dim">{escape(vehicle.about)}</p>'
        f'<div class="actions"><a class="first" href="{address}">{word}</a>'
        f'<a href="{escape(vehicle.new)}">New session</a></div>{sessions}</div></article>'
    )


def _line(left: Left) -> str:
    return (
        f'<li><a href="{escape(left.address)}"><img src="{escape(left.picture)}" alt="">'
        f'<span>{escape(left.title)}<span class="dim">{escape(left.about)}</span></span></a></li>'
    )


def _file(name: str) -> str:
    return files("modeviz.viewer.serving").joinpath(name).read_text("utf-8")
