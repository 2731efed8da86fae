"""Files of pictures, opened again by other libraries."""

import io

import av
import imageio.v3 as iio
import numpy as np
import pytest
from PIL import Image

from modeviz.report import images
from modeviz.report.images import SPREAD, gif_bytes, mp4_bytes, on_color, png_bytes

N, SECONDS = 12, 0.96
ORDER = range(N)


@pytest.fixture(scope="module")
def frames():
    """A red bar that runs back and forth once on a light gradient."""
    return [bar(round(60 + 40 * np.cos(2 * np.pi * k / N))) for k in range(N)]


def bar(x):
    content = np.zeros((96, 160, 3), np.uint8)
    content[:] = np.linspace(220, 250, 96)[:, None, None]
    content[30:60, x : x + 20] = 180, 60, 30
    return Image.fromarray(content)


def test_png_is_the_picture_with_its_transparency():
    content = np.arange(4 * 6 * 4, dtype=np.uint8).reshape(4, 6, 4)
    read = iio.imread(png_bytes(Image.fromarray(content)), extension=".png")
    np.testing.assert_array_equal(read, content)


def test_transparency_lets_the_colour_behind_shine_through():
    half = Image.new("RGBA", (2, 3), (255, 0, 0, 128))
    assert on_color(half, (255, 255, 255)).getpixel((0, 0)) == (255, 127, 127)
    clear = Image.new("RGBA", (2, 3), (0, 0, 0, 0))
    laid = on_color(clear, (0, 10, 20), (100, 110, 120))
    assert [laid.getpixel((1, y)) for y in range(3)] == [(0, 10, 20), (50, 60, 70), (100, 110, 120)]


def test_gif_loops_for_ever_over_all_frames_in_the_time_of_a_cycle(frames):
    with Image.open(io.BytesIO(gif_bytes(frames, ORDER, SECONDS))) as gif:
        assert (gif.format, gif.size, gif.n_frames, gif.info["loop"]) == ("GIF", (160, 96), N, 0)
        milliseconds = 0
        for k in range(N):
            gif.seek(k)
            milliseconds += gif.info["duration"]
            read = np.asarray(gif.convert("RGB")).astype(int)
            off = np.abs(read - np.asarray(frames[k])).max()
            assert off <= 4 + SPREAD / 2  # Pillow finds colours in steps of four
    assert milliseconds == 1000 * SECONDS


def test_gif_does_not_flicker_where_nothing_moves(frames):
    read = iio.imread(gif_bytes(frames, ORDER, SECONDS), extension=".gif")
    assert (read[:, :30] == read[0, :30]).all()


def test_gif_mixes_shades_that_its_colours_do_not_have(monkeypatch):
    monkeypatch.setattr(images, "N_COLORS", 8)  # of 60 shades: steps of 7.5 without a mixture
    shades = np.broadcast_to(np.linspace(100, 160, 256)[None, :, None], (64, 256, 3))
    frame = Image.fromarray(shades.round().astype(np.uint8))
    read = iio.imread(gif_bytes([frame, frame], [0, 1], SECONDS), extension=".gif")[0].astype(float)

    def seen(picture):
        """What an eye makes of eight by eight pixels."""
        return picture.reshape(8, 8, 32, 8, 3).mean(axis=(1, 3))

    steps = np.diff(seen(read), axis=1)
    assert steps.max() < 7.5 / 2


MIRRORED = [*range(N // 2 + 1), *range(N // 2 - 1, 0, -1)]


def test_gif_of_half_the_pictures_is_that_of_all_of_a_cycle_that_is_its_own_mirror(frames):
    assert gif_bytes(frames[: N // 2 + 1], MIRRORED, SECONDS) == gif_bytes(frames, ORDER, SECONDS)


def test_mp4_of_half_the_pictures_shows_them_forth_and_back(frames):
    content = mp4_bytes(frames[: N // 2 + 1], MIRRORED, SECONDS, n_cycles=2)
    with av.open(io.BytesIO(content)) as film:
        read = [frame.to_ndarray(format="rgb24").astype(int) for frame in film.decode(video=0)]
    assert len(read) == 2 * N
    for k, frame in enumerate(read):
        assert np.abs(frame - np.asarray(frames[k % N])).mean() < 2


def test_mp4_has_every_cycle_and_its_index_first(frames):
    content = mp4_bytes(frames, ORDER, SECONDS, n_cycles=3)
    assert content.find(b"moov") < content.find(b"mdat")
    with av.open(io.BytesIO(content)) as film:
        stream = film.streams.video[0]
        assert stream.codec_context.name == "h264"
        assert stream.codec_context.pix_fmt == "yuv420p"
        read = [frame.to_image() for frame in film.decode(stream)]
        assert float(stream.duration * stream.time_base) == pytest.approx(3 * SECONDS)
    assert len(read) == 3 * N
    for k, frame in enumerate(read):
        off = np.abs(np.asarray(frame).astype(int) - np.asarray(frames[k % N]))
        assert off.mean() < 2  # 4:2:0 blurs the colours of the bar's borders


def test_missing_pyav_is_told_with_what_to_install(frames, monkeypatch):
    monkeypatch.setattr(images, "find_spec", lambda name: None)
    with pytest.raises(images.ModevizError, match=r"pip install \"modeviz\[pictures\]\""):
        mp4_bytes(frames, ORDER, SECONDS, 1)
