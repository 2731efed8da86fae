"""The vehicle in the middle of the page: its bodies in a moving shape, its marks, the stage."""

from collections.abc import Callable, Mapping

import numpy as np
import viser
from numpy.typing import NDArray

from modeviz.shapes.colors import displacement_colors
from modeviz.shapes.gltf import glb
from modeviz.shapes.motion import DRAWN_FRACTION, default_amplitude, displacement, vertex_shapes
from modeviz.shapes.surface import Surface, surface
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.answers import Solved
from modeviz.viewer.assign import assign
from modeviz.viewer.driver import ShapeDriver
from modeviz.viewer.markers import Markers
from modeviz.viewer.stage import DARK, FIELD_OF_VIEW, ISO, LIGHT, Stage, Theme, box, camera

SHEET_ROLES = ("cabin", "bed")
"""Bodies that hide others: they are seen through, and their outlines are drawn."""

SEE_THROUGH = 0.5

UNTOUCHED = 1e-3
"""m: a camera this close to where it was put has not been moved by anybody."""


class Scene:
    """A vehicle on its stage. Handles are made once; what changes is assigned."""

    def __init__(
        self,
        server: viser.ViserServer,
        vehicle: Vehicle,
        dark: bool,
        on_select: Callable[[str], None],
    ) -> None:
        """Draws a vehicle at rest.

        Args:
            server: where, for all its pages.
            vehicle: what.
            dark: whether the page is.
            on_select: called with the group of a clicked mount.
        """
        scene, theme = server.scene, DARK if dark else LIGHT
        self._vehicle, self._box = vehicle, box(vehicle)
        self._server = server
        self._stage = Stage(scene, self._box, theme)
        self.driver = ShapeDriver(scene)
        self._surfaces = {body.name: surface(body.mesh) for body in vehicle.bodies if body.mesh}
        self._shapes = {
            body.name: vertex_shapes(body, self._surfaces[body.name].vertices)
            for body in self._drawn_bodies()
        }
        for body in self._drawn_bodies():
            _add_body(self.driver, body, self._surfaces[body.name], theme)
        self._ghosts = [
            _add_ghost(scene, body, self._surfaces[body.name], theme)
            for body in self._drawn_bodies()
            if body.role in SHEET_ROLES
        ]
        self._markers = Markers(scene, vehicle, on_select)
        self._views: dict[int, tuple[str, Floats]] = {}
        self._aim_cameras()

    def show(self, solved: Solved) -> None:
        """Draws the answer of a session: its mode's shape and energy, and how it wants to be seen."""
        state = solved.state
        coordinates = {
            name: solved.movement.shape[dofs] for name, dofs in solved.now.prepared.system.dofs.items()
        }
        with self._server.atomic():
            self.show_shape(coordinates, state.coloring == "displacement")
            self.show_style(state.coloring == "displacement", state.see_through, state.ghost == "rest")
            if solved.is_detailed:
                shares = {group: solved.strain[group] for group in state.rates}
                mode = solved.name.spoken
                self._markers.show(state.group, state.rates, shares, mode)

    def show_shape(self, coordinates: Mapping[str, NDArray], colored: bool) -> None:
        """Sends the page a shape, scaled so that it is clear to see at the driver's amplitude of one.

        Args:
            coordinates: of every body by name, (n_coordinates,), real or complex.
            colored: whether bodies have the colours of their displacement.
        """
        shapes = {name: displacement(s, coordinates[name]) for name, s in self._shapes.items()}
        scale = default_amplitude(shapes.values(), self._box.length)
        drawn = {_path(name): scale * shape for name, shape in shapes.items()}
        largest = DRAWN_FRACTION * self._box.length
        colors = None
        if colored:
            colors = {path: displacement_colors(shape, largest) for path, shape in drawn.items()}
        self.driver.show(drawn, colors)

    def show_style(self, colored: bool, see_through: bool, ghost: bool) -> None:
        """Chooses light and transparency, and whether the outlines at rest are there."""
        self._stage.light(colored)
        opacity = SEE_THROUGH if see_through and not colored else 1.0
        for body in self._drawn_bodies():
            if body.role in SHEET_ROLES:
                self.driver.set_opacity(_path(body.name), opacity)
        for outline in self._ghosts:
            assign(outline, visible=ghost)

    def look(self, client: viser.ClientHandle, view: str) -> None:
        """Turns a page's camera to one of `stage.VIEWS`."""
        position, look_at = camera(self._box, view, client.camera.aspect)
        self._views[client.client_id] = view, position
        with client.atomic():
            client.camera.position = position
            client.camera.look_at = look_at

    def _drawn_bodies(self) -> list[Body]:
        return [body for body in self._vehicle.bodies if body.name in self._surfaces]

    def _aim_cameras(self) -> None:
        """Points the cameras of pages to come at the vehicle."""
        initial = self._server.initial_camera
        initial.position, initial.look_at = camera(self._box, ISO, aspect=1.0)
        initial.fov = FIELD_OF_VIEW

        @self._server.on_client_connect
        def _(client: viser.ClientHandle) -> None:
            self.look(client, ISO)
            client.camera.on_update(lambda _: self._keep_framed(client))

        @self._server.on_client_disconnect
        def _(client: viser.ClientHandle) -> None:
            self._views.pop(client.client_id, None)

    def _keep_framed(self, client: viser.ClientHandle) -> None:
        """Looks again when the picture's shape has changed, unless somebody has moved the camera."""
        if client.client_id not in self._views:
            return
        view, position = self._views[client.client_id]
        framed, _ = camera(self._box, view, client.camera.aspect)
        is_untouched = np.allclose(client.camera.position, position, atol=UNTOUCHED)
        if is_untouched and not np.allclose(framed, position, atol=UNTOUCHED):
            self.look(client, view)


def _path(body: str) -> str:
    return f"/vehicle/{body.replace('/', '-')}"


def _add_body(driver: ShapeDriver, body: Body, drawn: Surface, theme: Theme) -> None:
    edge_color = theme.edges if body.role in SHEET_ROLES else None
    driver.add(_path(body.name), glb(drawn, edge_color), len(drawn.vertices), cast_shadow=True)


def _add_ghost(
    scene: viser.SceneApi, body: Body, drawn: Surface, theme: Theme
) -> viser.LineSegmentsHandle:
    """The outlines of a body at rest."""
    points = drawn.vertices[drawn.edges].astype(np.float32)
    path = f"/ghost/{body.name.replace('/', '-')}"
    return scene.add_line_segments(path, points, theme.ghost, thickness=1.0, thickness_units="screen")
