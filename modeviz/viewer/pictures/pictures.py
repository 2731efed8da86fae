"""Pictures of the 3-D view, drawn by a page: one, or a cycle of the shown motion."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Literal, Self

import numpy as np
import viser
from numpy.typing import NDArray
from PIL import Image

from modeviz.errors import ModevizError
from modeviz.report.images import on_color
from modeviz.report.scale_bar import ScaleBar, with_scale
from modeviz.shapes.colors import stop_colors
from modeviz.viewer.page.wire.connection import asked
from modeviz.viewer.page.wire.decoding import LARGEST_PICTURE
from modeviz.viewer.scene.stage import Theme
from modeviz.viewer.session.coloring import ColorScale

Backdrop = Literal["scene", "white", "transparent"]

SIZES = (16, LARGEST_PICTURE)
"""Least and most pixels of a side."""

TIMEOUT = 60.0
"""s: a picture takes long where a page renders in software."""

MOST_BYTES_PER_PIXEL = 5
"""Of a PNG file that is not compressed at all."""

N_FRAMES = 36
"""Of a cycle: 18 a second at the default speed."""

CYCLE_S = 2.0
"""s: of a cycle in a moving picture, as at the default speed on the page."""

N_CYCLES = 4
"""Of a film, which not every player repeats."""

LONGEST_SIDE = {"gif": 1280, "mp4": 1920}
"""Of a moving picture, pixels: more is megabytes that nobody sees."""


@dataclass(frozen=True)
class ImageSettings:
    """The settings of a picture."""

    width: int
    """Pixels."""
    height: int
    """Pixels."""
    backdrop: Backdrop
    theme: Theme
    """Of the scene; its colours are the backdrop "scene"."""
    field_of_view: float
    """From the top to the bottom of the picture, rad."""
    scale: ColorScale | None = None
    """What the colours of bodies mean, which the picture says if it is given."""

    def __post_init__(self) -> None:
        for name, side in (("width", self.width), ("height", self.height)):
            if not SIZES[0] <= side <= SIZES[1]:
                raise ModevizError(f"{name}: found {side}, expected {SIZES[0]} to {SIZES[1]} pixels")

    def moving(self, ending: Literal["gif", "mp4"]) -> "ImageSettings":
        """The same for a moving picture: opaque, no larger than wise, of even width and height."""
        scale = min(1.0, LONGEST_SIDE[ending] / max(self.width, self.height))
        width, height = (max(2 * round(scale * s / 2), SIZES[0]) for s in (self.width, self.height))
        backdrop = "white" if self.backdrop == "transparent" else self.backdrop
        return replace(self, width=width, height=height, backdrop=backdrop)


@dataclass(frozen=True)
class Cycle:
    """One cycle of a motion in pictures, at phases 2πk/n."""

    n_frames: int
    """n."""
    is_real: bool
    """Whether the shape is real: Re(φ e^{iθ}) is then the same at θ and 2π - θ, and drawn once."""

    @property
    def n_drawn(self) -> int:
        """The number of pictures that differ."""
        return self.n_frames // 2 + 1 if self.is_real else self.n_frames

    @property
    def order(self) -> list[int]:
        """The number of the picture that each frame shows."""
        n = self.n_frames
        return [min(k, n - k) if self.is_real else k for k in range(n)]


@dataclass(frozen=True, eq=False)
class Pose:
    """The place and the aim of a camera, whatever its page says of it later."""

    wxyz: NDArray[np.float64]
    """(4,), its orientation."""
    position: NDArray[np.float64]
    """(3,), m."""

    @classmethod
    def of(cls, camera: viser.CameraHandle) -> Self:
        """Return the pose of a page's camera now."""
        return cls(camera.wxyz, camera.position)


def picture(
    client: viser.ClientHandle, shot: ImageSettings, pose: Pose, timeout: float = TIMEOUT
) -> Image.Image:
    """The 3-D view of a page as it is, RGBA if the backdrop is transparent, else RGB.

    Args:
        client: the page.
        shot: how it is taken.
        pose: from where.
        timeout: how long the page may take, s.

    Raises:
        ModevizError: the page did not draw it, or not in time, or there is nothing to be seen.
    """
    try:
        with asked(client, MOST_BYTES_PER_PIXEL * shot.width * shot.height):
            drawn = client.get_render(
                shot.height,
                shot.width,
                wxyz=pose.wxyz,
                position=pose.position,
                fov=shot.field_of_view,
                transport_format="png",
                timeout=timeout,
            )
    except TimeoutError:
        raise ModevizError(
            f"the page did not draw it within {timeout:.0f} s: keep the page in front, "
            "or choose a smaller size"
        ) from None
    except RuntimeError as error:
        raise ModevizError(f"the page did not draw it: choose a smaller size ({error})") from None
    if drawn.shape != (shot.height, shot.width, 4) or drawn.dtype != np.uint8:
        raise ModevizError("the page drew it otherwise than asked: choose a smaller size")
    if not drawn[..., 3].any():
        raise ModevizError(
            "the picture is empty: the camera looks past the vehicle; choose another view"
        )
    return _explained(_on_backdrop(Image.fromarray(drawn), shot), shot)


def _on_backdrop(image: Image.Image, shot: ImageSettings) -> Image.Image:
    if shot.backdrop == "transparent":
        return image
    if shot.backdrop == "white":
        return on_color(image, (255, 255, 255))
    return on_color(image, shot.theme.top, shot.theme.bottom)


def _explained(image: Image.Image, shot: ImageSettings) -> Image.Image:
    """The picture with the scale of its colours, if they mean something."""
    if shot.scale is None:
        return image
    bar = ScaleBar(
        shot.scale.quantity, shot.scale.last, stop_colors(), shot.theme.ink, shot.theme.paper
    )
    return with_scale(image, bar)


def cycle_pictures(
    client: viser.ClientHandle,
    hold: Callable[[float], None],
    shot: ImageSettings,
    pose: Pose,
    cycle: Cycle,
    tell: Callable[[float], None],
    timeout: float = TIMEOUT,
) -> Iterator[Image.Image]:
    """The pictures of one cycle of the shown motion that differ.

    Args:
        client: the page.
        hold: lets it stand at a phase, from `driver.held`.
        shot: how they are taken.
        pose: from where.
        cycle: how many.
        tell: told the fraction of them that is drawn, before each.
        timeout: how long the page may take for each, s.

    Raises:
        ModevizError: as `picture` does.
    """
    for k in range(cycle.n_drawn):
        tell(k / cycle.n_drawn)
        hold(2 * math.pi * k / cycle.n_frames)
        yield picture(client, shot, pose, timeout)


def same_field_of_view(camera: viser.CameraHandle, width: int, height: int) -> float:
    """The one with which the square in the middle of a page's view is that of a picture's, rad."""
    zoom = min(1.0, camera.aspect) / min(1.0, width / height)
    return 2 * math.atan(zoom * math.tan(camera.fov / 2))
