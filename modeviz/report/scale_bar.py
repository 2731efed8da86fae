"""A scale of colours in the corner of a picture."""

from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from modeviz.vehicle.arrays import Floats

Color = tuple[int, int, int]

LETTERS = 1 / 36
"""Size of the letters, as a part of the picture's shorter side."""

SMALLEST = 8
"""Pixels: smaller letters nobody reads."""

BAR_WIDTH, BAR_HEIGHT = 8.0, 0.75
"""Of the bar, in sizes of the letters."""

PLATE = 217
"""Opacity of what is behind, of 255: that of the labels in the scene."""


@dataclass(frozen=True, eq=False)
class ScaleBar:
    """The words and the looks of a colour scale."""

    quantity: str
    last: str
    """What stands at its end; at its beginning stands 0."""
    stops: Floats
    """(n_stops, 3), sRGB from 0 to 255, equally spaced."""
    ink: Color
    paper: Color


def with_scale(image: Image.Image, scale: ScaleBar) -> Image.Image:
    """The picture, RGB or RGBA, with a scale in its lower left corner if that can be read there."""
    size = round(max(min(image.size) * LETTERS, SMALLEST))
    while size >= SMALLEST:
        plate = _plate(scale, size)
        if plate.width + 2 * size <= image.width and plate.height + 2 * size <= image.height:
            drawn = image.convert("RGBA")
            drawn.alpha_composite(plate, (size, image.height - size - plate.height))
            return drawn.convert(image.mode)
        size -= 1
    return image


def _plate(scale: ScaleBar, size: int) -> Image.Image:
    """The scale by itself, RGBA, in letters of that many pixels."""
    font = ImageFont.load_default(size)
    gap, height = round(0.6 * size), 2 * size
    texts = (scale.quantity, "0", scale.last)
    quantity, zero, last = (round(font.getlength(text)) for text in texts)
    bar = round(BAR_WIDTH * size), round(BAR_HEIGHT * size)
    lefts = np.cumsum([gap, quantity + 2 * gap, zero + gap, bar[0] + gap, last + gap]).tolist()
    plate = Image.new("RGBA", (lefts[-1], height), (*scale.paper, PLATE))
    plate.paste(_bar(scale.stops, *bar), (lefts[2], (height - bar[1]) // 2))
    draw = ImageDraw.Draw(plate)
    for text, left in zip(texts, (lefts[0], lefts[1], lefts[3]), strict=True):
        draw.text((left, height / 2), text, (*scale.ink, 255), font, anchor="lm")
    return plate


def _bar(stops: Floats, width: int, height: int) -> Image.Image:
    """The colours from the first to the last, from left to right."""
    places = np.linspace(0, len(stops) - 1, width)
    row = np.stack([np.interp(places, np.arange(len(stops)), channel) for channel in stops.T], axis=-1)
    return Image.fromarray(np.repeat(row[None].round().astype(np.uint8), height, axis=0))
