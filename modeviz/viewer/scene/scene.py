"""The vehicle in the middle of the page: its bodies in a moving shape, its marks, the stage."""

from collections.abc import Callable, Collection, Mapping
from contextlib import AbstractContextManager, nullcontext

import numpy as np
import viser

from modeviz.dynamics.assembly import System
from modeviz.errors import ModevizError
from modeviz.shapes.motion import default_amplitude
from modeviz.shapes.stand_in import drawn_mesh
from modeviz.text.wording import within_sentence
from modeviz.vehicle.arrays import Array
from modeviz.vehicle.bodies import Body
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.server import Server
from modeviz.viewer.scene.body_view import DrawnBody
from modeviz.viewer.scene.cameras import Cameras, Left, ignore_left
from modeviz.viewer.scene.driver import LARGEST, ShapeDriver
from modeviz.viewer.scene.following import Following
from modeviz.viewer.scene.markers import Markers
from modeviz.viewer.scene.mount_handle import Dragged, MountHandle
from modeviz.viewer.scene.rigid_axes import RigidAxesMarks
from modeviz.viewer.scene.stage import DARK, LIGHT, Box, Stage, bodies_box, box, framed_box
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.coloring import (
    Coloring,
    ColorScale,
    Shares,
    color_scale,
    energy_shares,
    shades,
    share_colors,
    strain_shares,
)
from modeviz.viewer.session.state import State
from modeviz.viewer.session.view import CameraPose


class Scene:
    """A vehicle on its stage. Handles are made once; what changes is assigned."""

    def __init__(
        self,
        server: Server,
        vehicle: Vehicle,
        dark: bool,
        on_select: Callable[[str], None],
        camera: CameraPose | None = None,
        left: Left = ignore_left,
    ) -> None:
        """Draws a vehicle at rest.

        Args:
            server: where, for all its pages.
            vehicle: what.
            dark: whether the page is.
            on_select: called with the group of a clicked mount.
            camera: where those of pages begin; None: where all is seen.
            left: told where cameras are left.
        """
        theme = self._theme = DARK if dark else LIGHT
        self._vehicle, self._box = vehicle, box(vehicle)
        self._server = server
        self._stage = Stage(server.scene, self._box, theme)
        self.driver: ShapeDriver = ShapeDriver(server.scene)
        drawn = filter(drawn_mesh, vehicle.bodies)
        self._bodies = [DrawnBody.of(self.driver, body, theme) for body in drawn]
        self._axes = RigidAxesMarks(server.scene, vehicle, self._box.length)
        self._markers = Markers(
            server.scene, vehicle, theme, self._box.length, on_select, self._axes.label_names
        )
        self._absorbers = {b.name: _at_rest(b) for b in vehicle.bodies if b.role == "absorber"}
        self._handle: MountHandle | None = None
        self.following: Following = Following(server, server.visitors.has_control)
        """Lets cameras of pages that only look go where that of whoever presents goes."""
        self._view = framed_box(vehicle)
        self._cameras = Cameras(server, self._view, camera, self.following.is_led, left)
        self.exaggeration: float = 1.0
        """How many times as large as it is the shape is drawn at the driver's amplitude of one."""

    def show(self, solved: Solved) -> None:
        """Draws the answer of a session: what moves in it, and how it wants to be seen."""
        state = solved.state
        shares = energy_shares(solved)
        with self._server.atomic():
            moving = solved.movement
            hidden = self._hidden(solved)
            drawn = self.show_shape(solved.now.prepared.system, moving.shape, moving.other, hidden)
            self.show_colors(state.look.coloring, drawn, shares)
            see_through = state.look.see_through and state.look.coloring == "bodies"
            has_ghost = state.look.ghost == "rest" or moving.other is not None
            self.show_bodies(hidden, see_through, has_ghost)
            self._show_axes(solved)
            if solved.is_detailed:
                strain = strain_shares(solved)
                groups = {group: strain[group] for group in state.design.rates}
                what = within_sentence(moving.title)
                group = state.group if moving.bodies is None else ""  # else no mount is at work
                self._markers.show(
                    group, state.design.rates, state.units, groups, what, share_colors(shares)
                )
        self._cameras.frame(self._framed(solved))

    def hold(self, given: Vehicle, altered: Vehicle) -> None:
        """Has in it the bodies and mounts of another vehicle, which differs by absorbers.

        Args:
            given: with its mounts as they were given.
            altered: with mounts and absorbers where they are.
        """
        if given is not self._vehicle:
            self._vehicle = given
            with self._server.atomic():
                self._markers.hold(given)
        wanted = {b.name: _at_rest(b) for b in altered.bodies if b.role == "absorber"}
        if wanted == self._absorbers:
            return
        stale = {name for name, rest in self._absorbers.items() if wanted.get(name) != rest}
        for body in [body for body in self._bodies if body.name in stale]:
            body.remove()
            self._bodies.remove(body)
        new = wanted.keys() - (self._absorbers.keys() - stale)
        added = [altered.body(name) for name in wanted if name in new]
        self._bodies += [DrawnBody.of(self.driver, body, self._theme) for body in added]
        self._absorbers = wanted

    def let_drag(
        self,
        on_drag: Callable[[Dragged], None],
        mistake: Callable[[Exception], object],
        has_control: Callable[[int], bool],
    ) -> None:
        """Lets pages drag the mounts of a group by a handle, where it is wanted; as `MountHandle`."""
        self._handle = MountHandle(self._server.scene, on_drag, mistake, has_control)

    def place(self, state: State) -> None:
        """Draws mounts where a state has them, and the handle of the selected group if it is wanted."""
        alterations, group = state.design.alterations, state.group
        self._markers.place(alterations.placements)
        if self._handle is None:
            return
        is_whole = state.motion.kind != "component"
        groups = {group.name: group for group in self._vehicle.mount_groups}
        if state.look.handle and is_whole and (given := groups.get(group)):
            self._handle.show(given, self._markers.carrier(group), alterations.placement(group))
        else:
            self._handle.hide()

    def without_handle(self) -> AbstractContextManager[None]:
        """Leaves out, inside a block, what is only for hands."""
        return self._handle.away() if self._handle else nullcontext()

    def close(self) -> None:
        """Ends what hears the handle."""
        if self._handle:
            self._handle.close()

    def _show_axes(self, solved: Solved) -> None:
        """Draws axes and centres of the body that is looked at, where they are wanted."""
        look, alone = solved.state.rigid, solved.movement.bodies
        if look.drawn and (alone is None or look.body in alone):
            self._axes.show(look.body, solved.rigid_axes, look.support)
        else:
            self._axes.hide()

    def color_scale(self, solved: Solved) -> ColorScale | None:
        """Return the scale of the colours of a picture, if they mean something.

        Raises:
            ModevizError: there is nothing to be seen in an answer but the ground.
        """
        hidden = self._hidden(solved)
        if all(b.name in hidden for b in self._bodies) and not self._markers.are_seen(hidden):
            raise ModevizError(
                "there is nothing to draw: no body that is shown has a mesh, and there are no mounts, "
                "tyres or response points"
            )
        return color_scale(solved)

    def _framed(self, solved: Solved) -> Box:
        """Return the box to look at: the body that moves alone, what is followed, or the vehicle."""
        state, alone = solved.state, solved.movement.bodies
        those = [] if alone is None else [b for b in self._vehicle.bodies if b.name in alone]
        drawn = [*filter(drawn_mesh, those)]
        if drawn:
            return bodies_box(drawn)
        groups = {group.name: group for group in solved.now.prepared.vehicle.mount_groups}
        if not state.look.follow or state.group not in groups:
            return self._view
        return self._view.around(np.mean([m.center for m in groups[state.group].mounts], axis=0))

    def _hidden(self, solved: Solved) -> Collection[str]:
        """The bodies that are not drawn: all but the one that moves alone, or those chosen."""
        alone = solved.movement.bodies
        if alone is None:
            return solved.state.look.hidden
        return {body.name for body in self._vehicle.bodies} - alone

    def show_shape(
        self, system: System, shape: Array, other: Array | None, hidden: Collection[str] = ()
    ) -> Mapping[str, Array]:
        """Sends the page a shape, scaled so that it is clear to see at the driver's amplitude of one.

        What would be too large to be sent is drawn smaller: a part of a millimetre that turns, in a
        vehicle of a hundred kilometres.

        Args:
            system: whose coordinates they are.
            shape: (n_dofs,), real or complex.
            other: the shape that outlines show, on the same scale; without it they rest.
            hidden: names of bodies that are not drawn, which the scale does not go by.

        Returns:
            The displacements of bodies by name as they are drawn, (n_vertices, 3), m.
        """
        shapes = {b.name: b.displacement(shape[system.dofs[b.name]]) for b in self._bodies}
        seen = [b for b in self._bodies if b.name not in hidden]
        areas = [b.areas for b in seen]
        scale = default_amplitude([shapes[b.name] for b in seen], areas, self._box.length)
        drawn = {name: scale * shape for name, shape in shapes.items()}
        points = {}
        for body in self._bodies:
            dofs = system.dofs[body.name]
            beside = None if other is None else scale * other[dofs]
            points |= body.points(drawn[body.name], scale * shape[dofs], beside)
        largest = max((float(np.abs(p).max(initial=0.0)) for p in points.values()), default=0.0)
        sent = min(1.0, LARGEST / largest) if largest else 1.0
        self.exaggeration = sent * scale
        self.driver.show(points if sent == 1 else {path: sent * p for path, p in points.items()})
        return drawn if sent == 1 else {name: sent * moved for name, moved in drawn.items()}

    def show_colors(self, coloring: Coloring, drawn: Mapping[str, Array], shares: Shares) -> None:
        """Colours bodies by what moves as drawn, and chooses the light for it."""
        self._stage.light(colored=coloring != "bodies")
        chosen = shades(coloring, drawn, self._box.length, shares)
        self.driver.shade({b.path: chosen[b.name] for b in self._bodies if b.name in chosen})

    def show_bodies(self, hidden: Collection[str], see_through: bool, ghost: bool) -> None:
        """Chooses what is drawn.

        Args:
            hidden: names of bodies that are not, nor what hangs only on them.
            see_through: whether sheet metal lets one see mounts and engine.
            ghost: whether outlines are drawn beside it.
        """
        for body in self._bodies:
            body.show(body.name not in hidden, see_through, ghost)
        self._markers.hide(hidden)

    def look(self, client: viser.ClientHandle, view: str) -> None:
        """Turns a page's camera to one of `stage.VIEWS`."""
        self._cameras.look(client, view)


def _at_rest(body: Body) -> tuple[float, ...]:
    """Where a body is drawn and how large, as numbers: its centre of gravity and its mass."""
    return (*map(float, body.center_of_gravity), body.mass)
