"""Moving shapes in the page: each mesh is sent once, after that only shapes travel.

Leans on private parts of viser 1.1.1: `RunJavascriptMessage` and `_queue_update` here, in driver.js
`__viserMutable`, `__viserSceneTree` and three.js' names of shader chunks. tests/browser/test_driver.py
fails when they change.
"""

import json
from dataclasses import dataclass, field
from importlib.resources import files

import numpy as np
import viser
from numpy.typing import NDArray
from viser import _messages

from modeviz.viewer.assign import assign

PREFIX = "/_shape"
"""Where the hidden point clouds are; the rest of their name is their mesh's."""

DRIVER = "/_driver"
"""The hidden node whose position is amplitude, frequency and phase."""

NO_COLORS = np.zeros(3, np.uint8)
"""One colour, and not one for each vertex: the page then draws the materials' own."""

LARGEST = float(np.finfo(np.float16).max)


@dataclass(frozen=True)
class DrivenMesh:
    """A mesh of the page and the hidden point cloud that tells it how to move."""

    mesh: viser.GlbHandle
    cloud: viser.PointCloudHandle
    n_vertices: int
    sent: dict[str, bytes] = field(default_factory=dict)
    """The newest content of the cloud's arrays, by property."""

    def send(self, name: str, array: NDArray) -> None:
        """Sends an array of the cloud if it is new; assigning it costs viser five passes over it."""
        content = array.tobytes()
        if content != self.sent.get(name):
            self.sent[name] = content
            own = np.frombuffer(content, array.dtype).reshape(array.shape)
            self.cloud._queue_update(name, own)

    def remove(self) -> None:
        """Takes both out of the page."""
        self.cloud.remove()
        self.mesh.remove()


class ShapeDriver:
    """The shapes of a scene and the one phase in which they all move.

    The page draws x + amplitude Re(φ e^{iθ}) on every mesh added here. θ advances in the page itself,
    so that playing costs no messages; a new page starts at the last phase that was sought.
    """

    def __init__(self, scene: viser.SceneApi) -> None:
        """Starts the page's script in a scene; its meshes stand still until told otherwise."""
        self._scene = scene
        self._meshes: dict[str, DrivenMesh] = {}
        self._amplitude, self._frequency_hz, self._running = 1.0, 1.0, False
        self._phase, self._n_seeks = 0.0, 0
        scene.add_frame(PREFIX, show_axes=False, visible=False)
        self._node = scene.add_frame(DRIVER, show_axes=False, visible=False)
        self._send_motion()
        script = files("modeviz.viewer").joinpath("driver.js").read_text("utf-8")
        source = f"({script.rstrip()})({json.dumps(PREFIX)}, {json.dumps(DRIVER)});"
        scene._websock_interface.queue_message(_messages.RunJavascriptMessage(source=source))

    def add(self, name: str, glb: bytes, n_vertices: int, *, cast_shadow: bool = False) -> None:
        """Adds a mesh, or replaces the one of that name, undeformed and in its own colours.

        Args:
            name: its place in the scene tree, "/vehicle/cab".
            glb: from `modeviz.shapes.gltf.glb`: indexed primitives on one vertex array.
            n_vertices: of that array.
            cast_shadow: whether it shades the ground, which sees it undeformed.
        """
        with self._scene._websock_interface.atomic():
            mesh = self._scene.add_glb(name, glb, cast_shadow=cast_shadow, receive_shadow=False)
            cloud = self._scene.add_point_cloud(
                PREFIX + name,
                np.zeros((n_vertices, 3), np.float16),
                NO_COLORS,
                point_size=1.0,
                precision="float16",
                visible=False,
            )
        self._meshes[name] = DrivenMesh(mesh, cloud, n_vertices)

    def remove(self, name: str) -> None:
        """Removes a mesh and its shape."""
        with self._scene._websock_interface.atomic():
            self._meshes.pop(name).remove()

    def show(self, name: str, shape: NDArray, colors: NDArray[np.uint8] | None = None) -> None:
        """Sends a mesh its shape φ and its colours; the last one sent is what every page shows.

        A real shape is half as long on the way as a complex one, and what has not changed stays here.

        Args:
            name: as it was added.
            shape: (n_vertices, 3), real or complex; single numbers beyond 65 504 cannot be sent.
            colors: (n_vertices, 3) sRGB of the skin; without them it has its own colour.

        Raises:
            ValueError: another number of vertices, or a value that is not finite or too large.
        """
        driven = self._meshes[name]
        expected = (driven.n_vertices, 3)
        if shape.shape != expected:
            raise ValueError(f"{name}: found a shape of {shape.shape}, expected {expected}")
        if colors is not None and colors.shape != expected:
            raise ValueError(f"{name}: found colours of {colors.shape}, expected {expected}")
        parts = np.concatenate([np.real(shape), np.imag(shape)]) if np.iscomplexobj(shape) else shape
        if not np.abs(parts).max(initial=0.0) <= LARGEST:
            raise ValueError(f"{name}: a displacement is not finite or beyond {LARGEST:.0f}")
        with self._scene._websock_interface.atomic():
            driven.send("points", parts.astype(np.float16))
            driven.send("colors", NO_COLORS if colors is None else colors)

    def set_opacity(self, name: str, factor: float) -> None:
        """Multiplies the opacity of a mesh's skin and glass."""
        assign(self._meshes[name].cloud, point_size=factor)

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
