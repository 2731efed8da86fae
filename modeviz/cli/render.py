"""The command that writes a picture, a loop, a film or an offline page."""

from argparse import ArgumentParser
from dataclasses import dataclass
from pathlib import Path
from typing import get_args

from modeviz.cli.command import Command
from modeviz.cli.interrupt import ended_by_interrupt
from modeviz.cli.options import RoadOptions, VehicleOptions, add_road, add_vehicle
from modeviz.cli.terminal import Teller, say
from modeviz.errors import located
from modeviz.files.disk import check_writable
from modeviz.study.pictures import (
    Background,
    Colors,
    PictureOptions,
    View,
    draw,
    image_settings,
    picture_kind,
)


@dataclass(frozen=True, kw_only=True)
class RenderOptions(VehicleOptions, PictureOptions, RoadOptions):
    """What `modeviz render` is asked for."""

    output: Path
    """Its ending says the kind of file."""


def render_file(options: RenderOptions) -> None:
    """Draws a vehicle in one of its modes and writes the file."""
    with ended_by_interrupt():
        import modeviz.viewer.rendering  # noqa: F401  viser alone takes a second

    with located("--output"):
        picture_kind(options.output)
    image_settings(options)
    check_writable(options.output)
    vehicle, rates = options.read()
    vehicle, conditions = options.shown(vehicle)
    try:
        draw(options.output, options, vehicle, rates, conditions, Teller())
    finally:
        say("")
    print(options.output)


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    command.add_argument(
        "--output",
        type=Path,
        required=True,
        metavar="FILE",
        help="its ending chooses: .png, .gif, .mp4 or .html",
    )
    command.add_argument("--mode", metavar="NAME", help='such as "cab yaw" (default)')
    command.add_argument("--view", choices=get_args(View))
    command.add_argument(
        "--color", choices=get_args(Colors), help="what the colours of the bodies mean"
    )
    command.add_argument(
        "--background",
        choices=get_args(Background),
        help="as on screen (default), or another; loops and films are never transparent, but white",
    )
    command.add_argument("--dark", action="store_true", help="the dark scene")
    command.add_argument("--width", type=int, help="pixels, default 1280")
    command.add_argument("--height", type=int, help="pixels, default 720")
    command.add_argument("--amplitude", type=float, help="times the usual one")
    command.add_argument(
        "--phase", type=float, metavar="DEGREES", help="of a PNG (default 0: the largest)"
    )
    command.add_argument("--frames", type=int, help="of a cycle in a GIF or MP4, default 36")
    add_road(command)


RENDER = Command(
    "render",
    "write a picture, a loop, a film or an offline page",
    RenderOptions,
    _add_options,
    render_file,
)
