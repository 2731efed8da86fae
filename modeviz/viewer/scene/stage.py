"""The stage: light, background, ground and camera, all placed by the size of the vehicle."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import viser

from modeviz.shapes.colors import Color
from modeviz.shapes.stand_in import drawn_mesh
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body
from modeviz.vehicle.vehicle import Vehicle

FIELD_OF_VIEW = 0.52
"""rad, vertical: that of a long lens, which keeps a vehicle's lines nearly parallel."""

ISO = "Iso"
VIEWS: Mapping[str, tuple[float, float, float]] = {
    ISO: (-4.6, -6.1, 2.75),
    "Side": (0.0, -1.0, 0.08),
    "Front": (-1.0, 0.0, 0.12),
    "Top": (0.0, -0.02, 1.0),
    "Under": (0.0, -0.02, -1.0),
}
"""From which direction; the driver's side faces us."""

FILLED = 0.94
"""How much of its picture a vehicle takes."""

AROUND_BLOCKS = 1.4
"""How many times their space is framed where nothing has a mesh: blocks reach its corners, and mounts
with their labels are at their borders."""

SMALLEST = 0.1
"""m: the length of what has none."""

NEAR, FAR = 0.002, 200.0
"""What a camera sees, as parts of the vehicle's length: from 1 cm to a kilometre on a pickup."""

CARD_HEIGHT, CARD_FRACTION = 300, 0.32
"""The card at the bottom hides so many pixels, of which so much of the picture is kept free."""


@dataclass(frozen=True)
class Theme:
    """The colours of an empty stage."""

    is_dark: bool
    top: Color
    bottom: Color
    cells: Color
    sections: Color
    shadow: float
    """Opacity of shadows on the ground."""
    edges: Color
    """The deformed borders and folds of a body."""
    ghost: Color
    """Those at rest."""
    ink: Color
    """Text on labels."""
    paper: Color
    """What it is on."""


LIGHT = Theme(
    is_dark=False,
    top=(223, 229, 235),
    bottom=(250, 251, 252),
    cells=(214, 220, 226),
    sections=(196, 204, 212),
    shadow=0.16,
    edges=(30, 36, 44),
    ghost=(120, 132, 146),
    ink=(16, 20, 26),
    paper=(255, 255, 255),
)
DARK = Theme(
    is_dark=True,
    top=(24, 28, 33),
    bottom=(40, 46, 53),
    cells=(70, 78, 88),
    sections=(84, 93, 104),
    shadow=0.28,
    edges=(150, 160, 172),
    ghost=(104, 113, 124),
    ink=(232, 236, 240),
    paper=(30, 34, 40),
)


@dataclass(frozen=True)
class Box:
    """The space a vehicle takes at rest."""

    low: tuple[float, float, float]
    high: tuple[float, float, float]

    @property
    def length(self) -> float:
        """The largest side, m."""
        return float(np.subtract(self.high, self.low).max()) or SMALLEST

    @property
    def middle(self) -> Floats:
        """The point that a camera turns about: low, for what matters are the mounts."""
        low, high = np.array(self.low), np.array(self.high)
        return low + (high - low) * (0.5, 0.5, 0.4)

    def grown(self, factor: float) -> "Box":
        """A space so many times as large with the same middle."""
        low, high = (
            self.middle + factor * (np.array(end) - self.middle) for end in (self.low, self.high)
        )
        return Box(tuple(low.tolist()), tuple(high.tolist()))

    def around(self, point: Floats) -> "Box":
        """As large a space with its middle at a point, (3,), m."""
        step = point - self.middle
        return Box(tuple((self.low + step).tolist()), tuple((self.high + step).tolist()))

    @property
    def corners(self) -> Floats:
        """(8, 3), m."""
        ends = np.array([self.low, self.high])
        return np.stack(np.meshgrid(*ends.T, indexing="ij"), axis=-1).reshape(-1, 3)


def box(vehicle: Vehicle) -> Box:
    """The space that is drawn of a vehicle: its meshes, connections and response points."""
    points = [_drawn(body) for body in vehicle.bodies]
    points += [connection.points for connection in vehicle.all_connections]
    points += [point.position[None] for point in vehicle.response_points]
    return points_box(points)


def framed_box(vehicle: Vehicle) -> Box:
    """The space that cameras look at: that of `box`, with room for labels around mere blocks."""
    drawn = box(vehicle)
    return drawn if any(body.mesh for body in vehicle.bodies) else drawn.grown(AROUND_BLOCKS)


def bodies_box(bodies: Iterable[Body]) -> Box:
    """The space that the meshes of bodies take."""
    return points_box([_drawn(body) for body in bodies])


def _drawn(body: Body) -> Floats:
    """The vertices of what is drawn of a body that its faces name, (n, 3), m."""
    parts = (part.vertices[np.unique(part.faces)] for part in drawn_mesh(body))
    return np.concatenate([np.zeros((0, 3)), *parts])


def points_box(points: Sequence[Floats]) -> Box:
    """The space that lots of points take, (n, 3) each, m; of none at all it has no size."""
    everything = np.concatenate([np.zeros((0, 3)), *points])
    if not len(everything):
        return Box((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    return Box(tuple(everything.min(axis=0).tolist()), tuple(everything.max(axis=0).tolist()))


def camera(box: Box, view: str, width: int, height: int) -> tuple[Floats, Floats]:
    """Return the place of the camera and the point it looks at, for one of `VIEWS`, m.

    The box fills the picture as far as it can and stays clear of the card at the bottom; what has no
    size is seen from `SMALLEST` away.

    Args:
        box: what to show.
        view: one of `VIEWS`.
        width: of the picture, CSS pixels.
        height: of the picture, CSS pixels.
    """
    backward = np.array(VIEWS[view]) / np.linalg.norm(VIEWS[view])
    right = np.cross([0, 0, 1.0], backward)
    right /= np.linalg.norm(right)
    up = np.cross(backward, right)
    half = np.tan(FIELD_OF_VIEW / 2)
    across, above, nearer = np.stack([right, up, backward]) @ (box.corners - box.middle).T
    below = 2 * min(CARD_HEIGHT / height, CARD_FRACTION) - 1
    x_range = FILLED * half * width / height * np.array([-1, 1])
    y_range = FILLED * half * np.array([below, 1])
    distance = max(_nearest(across, nearer, x_range), _nearest(above, nearer, y_range)) or SMALLEST
    look_at = box.middle + _moved(across, nearer, x_range, distance) * right
    look_at += _moved(above, nearer, y_range, distance) * up
    return look_at + distance * backward, look_at


def _nearest(places: Floats, nearer: Floats, seen: Floats) -> float:
    """The smallest distance from which points fit a camera that may be moved along `places`.

    A point is seen at (place - s) / (distance - nearer), which has to be within `seen` for some s.
    """
    low, high = seen
    reach = (places + high * nearer)[:, None] - (places + low * nearer)[None]
    return float(reach.max() / (high - low))


def _moved(places: Floats, nearer: Floats, seen: Floats, distance: float) -> float:
    """The smallest s that makes points fit from a distance."""
    low, high = seen
    lower = (places - high * (distance - nearer)).max()
    upper = (places - low * (distance - nearer)).min()
    return float(np.clip(0.0, lower, upper))


class Stage:
    """Light, background and ground of a scene."""

    def __init__(self, scene: viser.SceneApi, box: Box, theme: Theme) -> None:
        """Sets the stage for a vehicle of that size, which stands on z = 0."""
        self._scene, self._theme = scene, theme
        self._colored: bool | None = None
        scene.set_up_direction("+z")
        scene.world_axes.visible = False
        scene.set_background_image(_gradient(theme), format="png")
        scene.configure_default_lights(enabled=False)
        self._key = scene.add_light_directional(
            "/light/key", color=(255, 250, 242), cast_shadow=True, position=(-5.0, -7.0, 10.0)
        )
        scene.add_light_directional(
            "/light/fill", color=(226, 236, 255), intensity=0.35, position=(6.0, 8.0, 5.0)
        )
        scene.add_light_directional(
            "/light/under", color=(240, 244, 255), intensity=0.6, position=(-1.0, -2.0, -8.0)
        )
        self._sky = scene.add_light_hemisphere(
            "/light/sky", sky_color=(244, 248, 255), ground_color=(150, 150, 150)
        )
        self.lay_ground(box)
        self.light(colored=False)

    def lay_ground(self, box: Box, height: float = 0.0) -> None:
        """Lays the ground for what takes that space, at a height, m."""
        _add_ground(self._scene, box, self._theme, height)

    def light(self, colored: bool) -> None:
        """Lights shining bodies, or dimmer ones whose colours mean something."""
        if colored == self._colored:
            return
        self._colored = colored
        self._key.intensity = 1.1 if colored else 2.0
        self._sky.intensity = 0.4 if colored else 0.6
        environment = 0.28 if colored else 0.55
        self._scene.configure_environment_map("studio", environment_intensity=environment)


def _gradient(theme: Theme) -> np.ndarray:
    down = np.linspace(0, 1, 256)[:, None, None]
    colors = np.array(theme.top) * (1 - down) + np.array(theme.bottom) * down
    return np.repeat(colors.round().astype(np.uint8), 16, axis=1)


def _add_ground(scene: viser.SceneApi, box: Box, theme: Theme, height: float) -> None:
    cell = _round_length(box.length / 10)
    scene.add_grid(
        "/ground",
        width=2 * cell * round(1.3 * box.length / cell),
        height=2 * cell * round(0.95 * box.length / cell),
        position=(float(box.middle[0]), float(box.middle[1]), height),
        cell_size=cell,
        section_size=2 * cell,
        cell_color=theme.cells,
        cell_thickness=0.6,
        section_color=theme.sections,
        section_thickness=0.8,
        fade_distance=3 * box.length,
        fade_strength=2.0,
        shadow_opacity=theme.shadow,
    )


def _round_length(length: float) -> float:
    """The one of 1, 2 and 5 times a power of ten that is nearest, by ratio."""
    steps = np.outer(10.0 ** np.arange(-9, 9), (1, 2, 5)).ravel()
    return float(steps[np.abs(np.log(steps / length)).argmin()])
