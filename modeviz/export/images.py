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

if TYPE_CHECKING:
    from av import VideoFrame

Color = tuple[int, int, int]

N_COLORS = 256

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
    image.save(content, "PNG", optimize=True)
    return content.getvalue()


def gif_bytes(frames: Iterable[Image.Image], seconds: float) -> bytes:
    """An endless GIF of one cycle that takes `seconds`.

    All frames have the colours of the first one's palette and are not dithered: nothing flickers that
    does not move.

    Args:
        frames: of one size, RGB, evenly spaced in time; two or more.
        seconds: rounded so that each frame takes whole hundredths of a second, as GIF wants it.
    """
    images = iter(frames)
    first = next(images)
    palette = first.quantize(N_COLORS, Image.Quantize.MEDIANCUT)
    drawn = [
        image.quantize(palette=palette, dither=Image.Dither.NONE) for image in chain([first], images)
    ]
    hundredths = max(round(100 * seconds / len(drawn)), 2)  # browsers slow down what is faster
    content = BytesIO()
    drawn[0].save(
        content,
        "GIF",
        save_all=True,
        append_images=drawn[1:],
        duration=10 * hundredths,
        loop=0,
        optimize=False,
    )
    return content.getvalue()


def mp4_bytes(frames: Iterable[Image.Image], seconds: float, n_cycles: int) -> bytes:
    """An MP4 film (H.264, 4:2:0, index first) of a cycle that takes `seconds`, several times over.

    The cycle is compressed once and repeated: its first frame needs none before it.

    Args:
        frames: of one even size, RGB, evenly spaced in time; two or more.
        seconds: of one cycle.
        n_cycles: how often it is shown.

    Raises:
        ModevizError: PyAV is missing.
    """
    check_films()
    from av import VideoFrame

    images = [VideoFrame.from_image(frame).reformat(**YUV) for frame in frames]
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
