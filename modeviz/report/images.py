"""Pictures as files: PNG, GIF that loops, and MP4."""

from collections.abc import Iterable, Sequence
from fractions import Fraction
from importlib.util import find_spec
from io import BytesIO
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from modeviz.errors import ModevizError
from modeviz.vehicle.arrays import Floats

if TYPE_CHECKING:
    from av import VideoFrame

Color = tuple[int, int, int]

N_COLORS = 256

SPREAD = 8.0
"""How far apart the colours of a GIF may be where a shade between them is mixed, of 255."""

YUV = {"format": "yuv420p", "dst_colorspace": "ITU709"}
H264 = {
    "crf": "18",  # a loss that nobody sees
    "bf": "0",  # pictures in their order, so that a cycle ends where the next one begins
    "x264-params": "colorprim=bt709:transfer=bt709:colormatrix=bt709",
}
"""What x264 is told."""


def on_color(image: Image.Image, top: Color, bottom: Color | None = None) -> Image.Image:
    """A picture with transparency, laid on one colour or on a gradient from the top to the bottom."""
    down = np.linspace(0, 1, image.height)[:, None, None]
    rows = np.array(top) * (1 - down) + np.array(bottom or top) * down
    column = Image.fromarray(rows.round().astype(np.uint8))
    ground = column.resize(image.size, Image.Resampling.NEAREST).convert("RGBA")
    return Image.alpha_composite(ground, image.convert("RGBA")).convert("RGB")


def png_bytes(image: Image.Image) -> bytes:
    """The picture as a PNG file."""
    content = BytesIO()
    image.save(content, "PNG")
    return content.getvalue()


def gif_bytes(pictures: Iterable[Image.Image], order: Sequence[int], seconds: float) -> bytes:
    """An endless GIF of one cycle that takes `seconds`.

    All frames have the colours of the first one's palette, which a pattern that stands still mixes:
    shades have no steps, and nothing flickers that does not move.

    Args:
        pictures: of one size, RGB; two or more.
        order: which of them each frame shows; frames are evenly spaced in time.
        seconds: rounded so that each frame takes whole hundredths of a second, as GIF wants it.
    """
    images = iter(pictures)
    first = next(images)
    palette = first.quantize(N_COLORS, Image.Quantize.MEDIANCUT)
    mixed = [_mixed(image, palette) for image in chain([first], images)]
    start, *others = (mixed[i] for i in order)
    hundredths = max(round(100 * seconds / len(order)), 2)  # browsers slow down what is faster
    content = BytesIO()
    start.save(
        content,
        "GIF",
        save_all=True,
        append_images=others,
        duration=10 * hundredths,
        loop=0,
        optimize=False,
    )
    return content.getvalue()


def _mixed(image: Image.Image, palette: Image.Image) -> Image.Image:
    """A picture in the colours of a palette; eight by eight pixels mix a shade between two of them.

    Ordered dithering (B. E. Bayer, "An optimum method for two-level rendition of continuous-tone
    pictures", 1973).
    """
    across, down = -(-image.width // 8), -(-image.height // 8)
    square = SPREAD * ((_bayer(8) + 0.5) / 64 - 0.5)
    pattern = np.tile(square, (down, across))[: image.height, : image.width, None]
    shifted = np.asarray(image) + pattern
    exact = Image.fromarray(shifted.clip(0, 255).round().astype(np.uint8))
    return exact.quantize(palette=palette, dither=Image.Dither.NONE)


def _bayer(n: int) -> Floats:
    """The order in which pixels of a square get brighter, 0 to n² - 1, (n, n), n a power of two."""
    if n == 1:
        return np.zeros((1, 1))
    quarter = 4 * _bayer(n // 2)
    return np.block([[quarter, quarter + 2], [quarter + 3, quarter + 1]])


def mp4_bytes(
    pictures: Iterable[Image.Image], order: Sequence[int], seconds: float, n_cycles: int
) -> bytes:
    """An MP4 film (H.264, 4:2:0, index first) of a cycle that takes `seconds`, several times over.

    The cycle is compressed once and repeated: its first frame needs none before it.

    Args:
        pictures: of one even size, RGB; two or more.
        order: which of them each frame of a cycle shows; frames are evenly spaced in time.
        seconds: of one cycle.
        n_cycles: how often it is shown.

    Raises:
        ModevizError: PyAV is missing.
    """
    check_films()
    from av import VideoFrame

    converted = [VideoFrame.from_image(picture).reformat(**YUV) for picture in pictures]
    images = [converted[i] for i in order]
    with TemporaryDirectory() as folder:  # where the index goes first, the file is opened twice
        film = Path(folder, "film.mp4")
        _write_film(film, images, Fraction(len(images) / seconds).limit_denominator(1000), n_cycles)
        return film.read_bytes()


def check_films() -> None:
    """Raises ModevizError if PyAV, which makes films, is missing."""
    if not find_spec("av"):
        raise ModevizError('MP4 needs PyAV: pip install "modeviz[pictures]"; GIF works without')


def _write_film(path: Path, images: "Sequence[VideoFrame]", rate: Fraction, n_cycles: int) -> None:
    """Compresses a cycle at `rate` frames a second and writes it `n_cycles` times."""
    import av

    with av.open(path, "w", format="mp4", options={"movflags": "+faststart"}) as film:
        stream = film.add_stream("libx264", rate=rate, options=H264)
        stream.width, stream.height = images[0].width, images[0].height
        stream.pix_fmt, stream.gop_size = "yuv420p", len(images)
        packets = [packet for image in images for packet in stream.encode(image)]
        packets += stream.encode(None)
        for cycle in range(n_cycles):
            for i, packet in enumerate(packets):
                copy = av.Packet(bytes(packet))
                copy.stream, copy.time_base = stream, packet.time_base
                copy.pts = copy.dts = cycle * len(packets) + i
                copy.is_keyframe = packet.is_keyframe
                film.mux(copy)
