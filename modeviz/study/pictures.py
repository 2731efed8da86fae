"""Files with pictures of a study's vehicle, and what a notebook shows of them."""

import math
from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError
from modeviz.files.disk import write_bytes
from modeviz.report.comparison import RateSet
from modeviz.report.html import Picture
from modeviz.study.notebook import block
from modeviz.study.telling import Tell
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from modeviz.viewer.pictures.pictures import ImageSettings
    from modeviz.viewer.rendering import Kind, RenderRequest

View = Literal["Iso", "Side", "Front", "Top", "Under"]
Colors = Literal["bodies", "displacement", "kinetic energy", "strain energy"]
Background = Literal["scene", "white", "transparent"]

SHOWN = {
    ".png": '<img alt="{name}" style="max-width:100%" src="data:image/png;base64,{data}">',
    ".gif": '<img alt="{name}" style="max-width:100%" src="data:image/gif;base64,{data}">',
    ".mp4": '<video controls loop style="max-width:100%" src="data:video/mp4;base64,{data}"></video>',
    ".html": '<iframe title="{name}" width="100%" height="640" style="border:0" '
    'src="data:text/html;base64,{data}"></iframe>',
}
"""What shows a file in a notebook, by its ending; of others nothing but the name is shown."""


@dataclass(frozen=True)
class WrittenFile:
    """A file that was written; a notebook shows what is in it, if it is a picture or a page."""

    path: Path

    def __fspath__(self) -> str:
        return str(self.path)

    def _repr_html_(self) -> str:
        frame = SHOWN.get(self.path.suffix.lower())
        if frame is None:
            return block(str(self.path))
        data = b64encode(self.path.read_bytes()).decode()
        shown = frame.format(name=escape(self.path.name), data=data)
        return block(str(self.path), f"<div>{shown}</div>")


@dataclass(frozen=True, kw_only=True)
class PictureOptions:
    """What is to be seen, and how."""

    mode: str = ""
    """Its name; "" is the one that the page opens with."""
    view: View = "Iso"
    color: Colors = "bodies"
    """What the colours of bodies mean."""
    background: Background = "scene"
    dark: bool = False
    width: int = 1280
    """Pixels."""
    height: int = 720
    """Pixels."""
    amplitude: float = 1.0
    """Times the usual one."""
    phase: float = 0.0
    """Of a still picture, degrees: 0 is the largest."""
    frames: int = 36
    """Of a cycle of a moving one."""

    def __post_init__(self) -> None:
        for name, low, high in (("amplitude", 0, 10), ("phase", -360, 360), ("frames", 2, 240)):
            found = getattr(self, name)
            if not low <= found <= high:
                raise ModevizError(f"{name}: found {found:g}, expected {low} to {high}")


def picture_kind(path: Path) -> "Kind":
    """Return the kind of a picture file, which its ending says.

    Raises:
        ModevizError: it ends otherwise.
    """
    from modeviz.viewer.rendering import KINDS

    kind = KINDS.get(path.suffix.lower())
    if kind is None:
        raise ModevizError(f"found {path.name!r}, expected a name that ends in {', '.join(KINDS)}")
    return kind


def image_settings(options: PictureOptions) -> "ImageSettings":
    """Return how a picture is drawn; raises ModevizError for a size that is none."""
    from modeviz.viewer.pictures.pictures import ImageSettings
    from modeviz.viewer.scene.stage import DARK, FIELD_OF_VIEW, LIGHT

    theme = DARK if options.dark else LIGHT
    return ImageSettings(options.width, options.height, options.background, theme, FIELD_OF_VIEW)


def draw(
    path: Path,
    options: PictureOptions,
    vehicle: Vehicle,
    rates: Rates,
    conditions: Conditions,
    tell: Tell,
) -> None:
    """Draws a vehicle in one of its modes, and writes the file.

    Args:
        path: of the file, whose ending says its kind.
        options: what is to be seen, and how.
        vehicle: with the rates that all is compared with.
        rates: to show it with.
        conditions: of the plots in an offline page.
        tell: told how far it is.

    Raises:
        ModevizError: there is no such mode, what draws is missing, or the file cannot be written.
    """
    from modeviz.viewer.rendering import render

    request, settings = _request(options), image_settings(options)
    content = render(vehicle, rates, conditions, request, settings, picture_kind(path), tell)
    write_bytes(path, content)


def report_pictures(
    vehicle: Vehicle, sets: Sequence[RateSet], conditions: Conditions, tell: Tell
) -> list[Picture]:
    """Return a picture with each of two sets of rates: the mode that the page opens with.

    Raises:
        ModevizError: what draws is missing.
    """
    from modeviz.viewer.rendering import photographs

    request, settings = _request(REPORT_PICTURE), image_settings(REPORT_PICTURE)
    return photographs(vehicle, sets, conditions, request, settings, tell)


def _request(options: PictureOptions) -> "RenderRequest":
    """Return what is to be seen, as the viewer has it."""
    from modeviz.viewer.rendering import RenderRequest

    phase = math.radians(options.phase)
    return RenderRequest(
        options.mode, options.view, options.color, options.amplitude, phase, options.frames
    )


REPORT_PICTURE = PictureOptions(background="white", width=1280, height=800)
