"""Files with pictures of a study's vehicle, and what a notebook shows of them."""

import math
from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Literal

from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError
from modeviz.report.comparison import RateSet
from modeviz.report.html import Picture
from modeviz.study.notebook import block
from modeviz.study.telling import Tell
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.vehicle import Vehicle

View = Literal["Iso", "Side", "Front", "Top", "Under"]
Colors = Literal["bodies", "displacement", "kinetic energy", "strain energy"]
Background = Literal["scene", "white", "transparent"]

REPORT_SIZE = (1280, 800)
"""Pixels of a report's pictures."""

SHOWN = {
    ".png": '<img alt="{name}" style="max-width:100%" src="data:image/png;base64,{data}">',
    ".gif": '<img alt="{name}" style="max-width:100%" src="data:image/gif;base64,{data}">',
    ".mp4": '<video controls loop style="max-width:100%" src="data:video/mp4;base64,{data}"></video>',
    ".html": '<iframe title="{name}" width="100%" height="640" style="border:0" '
    'src="data:text/html;base64,{data}"></iframe>',
}
"""What shows a file in a notebook, by its ending."""


@dataclass(frozen=True)
class WrittenFile:
    """A file that was written; a notebook shows what is in it."""

    path: Path

    def __fspath__(self) -> str:
        return str(self.path)

    def _repr_html_(self) -> str:
        data = b64encode(self.path.read_bytes()).decode()
        shown = SHOWN[self.path.suffix.lower()].format(name=escape(self.path.name), data=data)
        return block(str(self.path), f"<div>{shown}</div>")


@dataclass(frozen=True)
class PictureOptions:
    """What is to be seen, and how."""

    mode: str
    """Its name; "" is the one that the page opens with."""
    view: View
    color: Colors
    """What the colours of bodies mean."""
    background: Background
    dark: bool
    width: int
    """Pixels."""
    height: int
    """Pixels."""
    amplitude: float
    """Times the usual one."""
    phase: float
    """Of a still picture, degrees: 0 is the largest."""
    frames: int
    """Of a cycle of a moving one."""

    def __post_init__(self) -> None:
        for name, low, high in (("amplitude", 0, 10), ("phase", -360, 360), ("frames", 2, 240)):
            found = getattr(self, name)
            if not low <= found <= high:
                raise ModevizError(f"{name}: found {found:g}, expected {low} to {high}")


def draw(
    vehicle: Vehicle,
    rates: Rates,
    conditions: Conditions,
    path: Path,
    options: PictureOptions,
    tell: Tell,
) -> bytes:
    """Return the content of a picture file, whose ending says its kind.

    Args:
        vehicle: with the rates that all is compared with.
        rates: to show it with.
        conditions: of the plots in an offline page.
        path: of the file.
        options: what is to be seen, and how.
        tell: told how far it is.

    Raises:
        ModevizError: the path ends otherwise, there is no such mode, or what draws is missing.
    """
    from modeviz.viewer.pictures.pictures import ImageSettings
    from modeviz.viewer.rendering import KINDS, RenderRequest, render
    from modeviz.viewer.scene.stage import DARK, FIELD_OF_VIEW, LIGHT

    kind = KINDS.get(path.suffix.lower())
    if kind is None:
        raise ModevizError(f"found {path.name!r}, expected a name that ends in {', '.join(KINDS)}")
    theme = DARK if options.dark else LIGHT
    settings = ImageSettings(options.width, options.height, options.background, theme, FIELD_OF_VIEW)
    request = RenderRequest(
        options.mode,
        options.view,
        options.color,
        options.amplitude,
        math.radians(options.phase),
        options.frames,
    )
    return render(vehicle, rates, conditions, request, settings, kind, tell)


def report_pictures(
    vehicle: Vehicle, sets: Sequence[RateSet], conditions: Conditions, tell: Tell
) -> list[Picture]:
    """Return a picture with each of two sets of rates: the mode that the page opens with.

    Raises:
        ModevizError: what draws is missing.
    """
    from modeviz.viewer.pictures.pictures import ImageSettings
    from modeviz.viewer.rendering import RenderRequest, photographs
    from modeviz.viewer.scene.stage import FIELD_OF_VIEW, ISO, LIGHT

    request = RenderRequest("", ISO, "bodies", amplitude=1.0, phase=0.0, n_frames=1)
    settings = ImageSettings(*REPORT_SIZE, "white", LIGHT, FIELD_OF_VIEW)
    return photographs(vehicle, sets, conditions, request, settings, tell)
