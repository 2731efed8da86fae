"""The command that writes a picture, a loop, a film or an offline page."""

import math
from argparse import Namespace

from modeviz.cli.interrupt import ended_by_interrupt
from modeviz.cli.options import shown, vehicle_and_rates
from modeviz.cli.terminal import Teller, say
from modeviz.errors import ModevizError
from modeviz.files.disk import check_writable, write_bytes


def render_file(options: Namespace) -> None:
    """Draws a vehicle in one of its modes and writes the file."""
    with ended_by_interrupt():
        from modeviz.viewer.pictures.pictures import (
            ImageSettings,  # viser alone takes a second to import
        )
        from modeviz.viewer.rendering import KINDS, RenderRequest, render
        from modeviz.viewer.scene.stage import DARK, FIELD_OF_VIEW, LIGHT

    kind = KINDS.get(options.output.suffix.lower())
    if kind is None:
        raise ModevizError(
            f"--output: found {options.output.name!r}, expected a name that ends in {', '.join(KINDS)}"
        )
    theme = DARK if options.dark else LIGHT
    shot = ImageSettings(options.width, options.height, options.background, theme, FIELD_OF_VIEW)
    _check("--amplitude", options.amplitude, 0, 10)
    _check("--phase", options.phase, -360, 360)
    _check("--frames", options.frames, 2, 240)
    check_writable(options.output)
    vehicle, rates = vehicle_and_rates(options)
    vehicle, chosen = shown(options, vehicle)
    wish = RenderRequest(
        options.mode,
        options.view,
        options.color,
        options.amplitude,
        math.radians(options.phase),
        options.frames,
    )
    try:
        content = render(vehicle, rates, chosen, wish, shot, kind, Teller())
    finally:
        say("")
    write_bytes(options.output, content)
    print(options.output)


def _check(option: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise ModevizError(f"{option}: found {value:g}, expected {low:g} to {high:g}")
