"""Moving shapes in the page: each mesh is sent once, after that only shapes travel.

The shapes of all meshes are one array, because a message costs the server more than what is in it.

Leans on private parts of viser 1.1.1: `RunJavascriptMessage` here, in driver.js `__viserMutable`,
`__viserSceneTree` and three.js' names of shader chunks. tests/browser/test_driver.py fails when they
change.
"""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from importlib.resources import files

import numpy as np
import viser
from numpy.typing import NDArray
from viser import _messages

from modeviz.viewer.assign import send

PREFIX = "/_shape"
"""Where the hidden nodes of the meshes are; the rest of their name is their mesh's. Their position is
the mesh's place among the shapes, its number of vertices and the opacity of its skin."""

CLOUD = "/_shapes"
"""The hidden point cloud that carries the shapes, one after the other."""

DRIVER = "/_driver"
"""The hidden node whose position is amplitude, frequency and phase."""

HELD = "/_held"
"""The hidden node of one page alone: while it is there, its position is the phase of that page."""

NO_COLORS = np.zeros(3, np.uint8)
"""One colour, and not one for each vertex: the page then draws the materials' own."""

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
        self._shapes: dict[str, NDArray] = {}
        self._sent: dict[str, bytes] = {}
        self._n_added = 0
        self._amplitude, self._frequency_hz, self._running = 1.0, 1.0, False
        self._phase, self._n_seeks = 0.0, 0
        scene.add_frame(PREFIX, show_axes=False, visible=False)
        self._cloud = scene.add_point_cloud(
            CLOUD,
            np.zeros((0, 3), np.float16),
            NO_COLORS,
            point_size=1.0,
            precision="float16",
            visible=False,
        )
        self._node = scene.add_frame(DRIVER, show_axes=False, visible=False)
        self._send_motion()
        script = files("modeviz.viewer").joinpath("driver.js").read_text("utf-8")
        names = ", ".join(map(json.dumps, (PREFIX, CLOUD, DRIVER, HELD)))
        source = f"({script.rstrip()})({names});"
        scene._websock_interface.queue_message(_messages.RunJavascriptMessage(source=source))

    def add(self, name: str, glb: bytes, n_vertices: int, *, cast_shadow: bool = False) -> None:
        """Adds a mesh, or replaces the one of that name, undeformed; colours have to be shown anew.

        Args:
            name: its place in the scene tree, "/vehicle/cab".
            glb: from `modeviz.shapes.gltf.glb`: indexed primitives on one vertex array.
            n_vertices: of that array.
            cast_shadow: whether it shades the ground, which sees it undeformed.
        """
        self._n_added += 1
        with self._scene._websock_interface.atomic():
            self._meshes[name] = self._scene.add_glb(
                name, glb, cast_shadow=cast_shadow, receive_shadow=False
            )
            self._nodes[name] = self._scene.add_frame(
                PREFIX + name,
                show_axes=False,
                position=(self._n_added, n_vertices, 1.0),
                visible=False,
            )
            self._shapes.pop(name, None)  # the newest mesh is the last
            self._shapes[name] = np.zeros((n_vertices, 3), np.float32)
            self.show({})

    def remove(self, name: str) -> None:
        """Removes a mesh and its shape; colours have to be shown anew."""
        with self._scene._websock_interface.atomic():
            self._meshes.pop(name).remove()
            self._nodes.pop(name).remove()
            del self._shapes[name]
            self.show({})

    def show(
        self, shapes: Mapping[str, NDArray], colors: Mapping[str, NDArray[np.uint8]] | None = None
    ) -> None:
        """Sends meshes their shapes φ and their colours; the last ones sent are what every page shows.

        Real shapes are half as long on the way as complex ones, and nothing new is nothing sent.

        Args:
            shapes: (n_vertices, 3) by mesh, real or complex; a mesh that is left out keeps its own.
                Single numbers beyond 65 504 cannot be sent.
            colors: (n_vertices, 3) sRGB of the skin, of every mesh; without them it has its own colour.

        Raises:
            ValueError: another number of vertices, or a value that is not finite or too large.
        """
        _check_lengths("a shape", shapes, self._shapes)
        newest = {**self._shapes, **shapes}
        points = _halves(newest.values())
        skins = NO_COLORS
        if colors is not None:
            _check_lengths("colours", colors, newest)
            skins = np.concatenate([colors[name] for name in newest])
        self._shapes = newest
        with self._scene._websock_interface.atomic():
            self._send_if_new("points", points)
            self._send_if_new("colors", skins)

    def set_opacity(self, name: str, factor: float) -> None:
        """Multiplies the opacity of a mesh's skin and glass."""
        node = self._nodes[name]
        order, n_vertices, opacity = node.position
        if factor != opacity:
            node.position = (order, n_vertices, factor)

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

    def _send_motion(self) -> None:
        # the page seeks when this number changes, so going to the same phase again adds a whole turn
        sought = self._phase % (2 * np.pi) + 2 * np.pi * (self._n_seeks % 1000)
        frequency_hz = self._frequency_hz if self._running else 0.0
        self._node.position = (self._amplitude, frequency_hz, sought)

    def _send_if_new(self, name: str, array: NDArray) -> None:
        content = array.tobytes()  # compared as numbers, halves would take ten times as long
        if content != self._sent.get(name):
            self._sent[name] = content
            send(self._cloud, name, array)


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


def _check_lengths(what: str, found: Mapping[str, NDArray], expected: Mapping[str, NDArray]) -> None:
    """Raises ValueError if an array does not go with its mesh."""
    for name, array in found.items():
        if array.shape != expected[name].shape:
            raise ValueError(f"{name}: found {what} of {array.shape}, expected {expected[name].shape}")


def _halves(shapes: Iterable[NDArray]) -> NDArray[np.float16]:
    """All shapes in one; if any is complex, the real parts of all come before the imaginary ones.

    Raises:
        ValueError: a value is not finite or too large.
    """
    whole = np.concatenate([np.zeros((0, 3), np.float32), *shapes])
    parts = np.concatenate([whole.real, whole.imag]) if np.iscomplexobj(whole) else whole
    if not np.abs(parts).max(initial=0.0) <= LARGEST:
        raise ValueError(f"a displacement is not finite or beyond {LARGEST:.0f}")
    return parts.astype(np.float16)
