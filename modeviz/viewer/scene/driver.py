"""Moving shapes in the page: each mesh is sent once, after that only shapes travel.

The shapes of all meshes are one array, because a message costs the server more than what is in it.

Leans on private parts of viser 1.1.1: in driver.js `__viserMutable`, `__viserSceneTree` and three.js'
names of shader chunks. tests/browser/test_driver.py fails when they change.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager

import numpy as np
import viser
from numpy.typing import NDArray

from modeviz.shapes.colors import Shade, stop_colors
from modeviz.vehicle.arrays import Array
from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.page.widgets.handles import announce, assign, at_once

PREFIX = "/_shape"
"""Where the hidden nodes of the meshes are; the rest of their name is their mesh's. Their position is
the mesh's place among the shapes, the number of points of its shape and the opacity of its skin; their
orientation is the gain and the power of its shade, 1 if it has one, and 0."""

SHAPES = "/_shapes"
"""The hidden node that carries the shapes, see `_packed`."""

DRIVER = "/_driver"
"""The hidden node whose position is amplitude, frequency and phase."""

HELD = "/_held"
"""The hidden node of one page alone: while it is there, its position is the phase of that page."""

UNSHADED = (1.0, 0.0, 0.0, 0.0)

AT_REST = np.zeros((2, 3), np.float32)
"""The shape of a mesh that stands still, as a rigid motion."""

LARGEST = float(np.finfo(np.float16).max)


class ShapeDriver:
    """The shapes of a scene and the one phase in which they all move.

    The page draws x + amplitude Re(φ e^{iθ}) on every mesh added here. θ advances in the page itself,
    so that playing costs no messages; a new page starts at the last phase that was sought.
    """

    def __init__(self, scene: viser.SceneApi) -> None:
        """Starts the page's script in a scene; its meshes stand still until told otherwise."""
        self._scene = scene
        self._meshes: dict[str, viser.GlbHandle] = {}
        self._nodes: dict[str, viser.FrameHandle] = {}
        self._n_vertices: dict[str, int] = {}
        self._shapes: dict[str, Array] = {}
        self._n_added = 0
        self._amplitude, self._frequency_hz, self._running = 1.0, 1.0, False
        self._phase, self._n_seeks = 0.0, 0
        scene.add_frame(PREFIX, show_axes=False, visible=False)
        self._carrier = scene.add_frame(SHAPES, show_axes=False, visible=False)
        self._send_shapes(b"")
        self._node = scene.add_frame(DRIVER, show_axes=False, visible=False)
        self._send_motion()
        stops = (stop_colors() / 255).tolist()
        scripts.run(scene, "scene/driver.js", PREFIX, SHAPES, DRIVER, HELD, stops)

    def add(self, name: str, glb: bytes, n_vertices: int, *, cast_shadow: bool = False) -> None:
        """Adds a mesh, or replaces the one of that name, at rest and in its own colours.

        Args:
            name: its place in the scene tree, "/vehicle/cab".
            glb: from `modeviz.shapes.gltf.glb`: indexed primitives on one vertex array.
            n_vertices: of that array.
            cast_shadow: whether it shades the ground, which sees it undeformed.
        """
        self._n_added += 1
        with at_once(self._scene):
            self._meshes[name] = self._scene.add_glb(
                name, glb, cast_shadow=cast_shadow, receive_shadow=False
            )
            self._nodes[name] = self._scene.add_frame(
                PREFIX + name,
                show_axes=False,
                position=(self._n_added, len(AT_REST), 1.0),
                wxyz=UNSHADED,
                visible=False,
            )
            self._n_vertices[name] = n_vertices
            self._shapes.pop(name, None)  # the newest mesh is the last
            self.show({name: AT_REST})

    def remove(self, name: str) -> None:
        """Removes a mesh and its shape."""
        with at_once(self._scene):
            self._meshes.pop(name).remove()
            self._nodes.pop(name).remove()
            del self._shapes[name], self._n_vertices[name]
            self.show({})

    def show(self, shapes: Mapping[str, Array]) -> None:
        """Sends meshes their shapes φ; the last ones sent are what every page shows.

        Real shapes are half as long on the way as complex ones, and nothing new is nothing sent.

        Args:
            shapes: by mesh, real or complex; a mesh that is left out keeps its own. (n_vertices, 3), or
                (2, 3) for a rigid motion: the displacement of the mesh's first vertex, and the rotation
                θ, so that a vertex at r from the first one moves by u + θ x r. Single numbers beyond
                65 504 cannot be sent.

        Raises:
            ValueError: another number of vertices, or a value that is not finite or too large.
        """
        for name, shape in shapes.items():
            expected = (self._n_vertices[name], 3)
            if shape.shape not in (expected, AT_REST.shape):
                raise ValueError(f"{name}: found a shape of {shape.shape}, expected {expected}")
        newest = {**self._shapes, **shapes}
        content = _packed(_halves(newest.values()))
        self._shapes = newest
        with at_once(self._scene):
            for name, shape in shapes.items():
                order, n_points, opacity = self._nodes[name].position
                if n_points != len(shape):
                    self._nodes[name].position = (order, len(shape), opacity)
            if content != self._sent:
                self._send_shapes(content)

    @property
    def is_real(self) -> bool:
        """Whether all shapes are real: their motion is then its own mirror in time."""
        return not any(np.iscomplexobj(shape) for shape in self._shapes.values())

    def shade(self, shades: Mapping[str, Shade]) -> None:
        """Colours the skins of meshes by how they move; a mesh without a shade has its own colours."""
        for name, node in self._nodes.items():
            found = shades.get(name)
            coded = UNSHADED if found is None else (found.gain, float(found.power), 1.0, 0.0)
            if tuple(node.wxyz) != coded:
                node.wxyz = coded

    def set_visible(self, name: str, visible: bool) -> None:
        """Draws a mesh or leaves it out."""
        assign(self._meshes[name], visible=visible)

    def set_opacity(self, name: str, factor: float) -> None:
        """Multiplies the opacity of a mesh's skin and glass."""
        node = self._nodes[name]
        order, n_points, opacity = node.position
        if factor != opacity:
            node.position = (order, n_points, factor)

    def drive(
        self,
        amplitude: float | None = None,
        frequency_hz: float | None = None,
        running: bool | None = None,
    ) -> None:
        """Changes how the shapes move; what is not given stays, and the phase is never broken.

        Args:
            amplitude: the factor on all shapes.
            frequency_hz: cycles a second on the screen.
            running: whether the phase advances; stopped, it is held, and goes on from there.
        """
        self._amplitude = self._amplitude if amplitude is None else amplitude
        self._frequency_hz = self._frequency_hz if frequency_hz is None else frequency_hz
        self._running = self._running if running is None else running
        self._send_motion()

    def seek(self, phase: float) -> None:
        """Moves every page to a phase θ, rad, from which it goes on if it is running."""
        self._phase = phase
        self._n_seeks += 1
        self._send_motion()

    @property
    def sought(self) -> float:
        """The value of `__modeviz.sought` on a page that has come to the last phase sought."""
        # the page seeks when this number changes, so going to the same phase again adds a whole turn
        return self._phase % (2 * np.pi) + 2 * np.pi * (self._n_seeks % 1000)

    def _send_shapes(self, content: bytes) -> None:
        self._sent = content
        announce(self._carrier, "shapes", content)

    def _send_motion(self) -> None:
        frequency_hz = self._frequency_hz if self._running else 0.0
        self._node.position = (self._amplitude, frequency_hz, self.sought)


@contextmanager
def held(client: viser.ClientHandle) -> Iterator[Callable[[float], None]]:
    """Lets one page stand at phases θ, rad, given to what this yields; then it goes on where it was.

    A picture that is asked for after a phase was given shows that phase. Other pages move on.
    """
    node = client.scene.add_frame(HELD, show_axes=False, visible=False)

    def hold(phase: float) -> None:
        node.position = (phase, 0.0, 0.0)

    try:
        yield hold
    finally:
        node.remove()


def _halves(shapes: Iterable[Array]) -> NDArray[np.float16]:
    """All shapes in one; if any is complex, the real parts of all come before the imaginary ones.

    Raises:
        ValueError: a value is not finite or too large.
    """
    whole = np.concatenate([np.zeros((0, 3), np.float32), *shapes])
    parts = np.concatenate([whole.real, whole.imag]) if np.iscomplexobj(whole) else whole
    if not np.abs(parts).max(initial=0.0) <= LARGEST:
        raise ValueError(f"a displacement is not finite or beyond {LARGEST:.0f}")
    return parts.astype(np.float16)


def _packed(points: NDArray[np.float16]) -> bytes:
    """Halves so ordered that compression makes them small; the page undoes it.

    All x come before all y and z, each number as its step from the one before, which is small between
    neighbours; all low bytes of the steps come before all high ones, which are mostly alike. viser
    compresses bytes but no arrays.
    """
    steps = np.diff(points.T.reshape(-1).view(np.uint16), prepend=np.uint16(0))
    return steps.view(np.uint8).reshape(-1, 2).T.tobytes()
