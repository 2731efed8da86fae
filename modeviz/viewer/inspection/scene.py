"""Bodies on a stage: one moves in a mode of its own, the others rest; attachments go along."""

from collections.abc import Sequence

import numpy as np
import viser

from modeviz.errors import cut
from modeviz.shapes.colors import displacement_shade
from modeviz.shapes.gltf import glb
from modeviz.shapes.motion import DRAWN_FRACTION, default_amplitude
from modeviz.shapes.points import octahedra
from modeviz.shapes.surface import surface
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Material, MeshPart
from modeviz.viewer.inspection.state import Content, State
from modeviz.viewer.inspection.subject import Mark, Subject
from modeviz.viewer.page.server import Server
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.scene.body_view import DrawnBody
from modeviz.viewer.scene.cameras import Cameras
from modeviz.viewer.scene.driver import AT_REST, LARGEST, ShapeDriver
from modeviz.viewer.scene.labels import LABEL_LETTERS, keep_apart
from modeviz.viewer.scene.mark_colors import BLUE
from modeviz.viewer.scene.stage import DARK, LIGHT, Box, Stage, Theme, points_box

MARK_RADIUS = 0.008
"""Of an attachment, as a part of the largest side of what is drawn."""

MOST_LABELS = 60
"""Of attachments: more would find no place."""

EMPTY = Box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
"""What is looked at where there is nothing."""

NO_CARD = "/no-card"


class DrawnSubject:
    """A subject in the page: its surface, its attachments and their names."""

    def __init__(
        self,
        scene: viser.SceneApi,
        driver: ShapeDriver,
        subject: Subject,
        theme: Theme,
        size: float,
    ) -> None:
        """Draws a subject at rest; the largest side of all that is drawn, m, gives marks their size."""
        self._scene, self._driver = scene, driver
        self.subject: Subject = subject
        self._body = None
        if len(subject.drawn.vertices):
            self._body = DrawnBody(
                driver, subject.name, subject.drawn, subject.shapes, theme, is_sheet=not subject.modes
            )
        path = f"/attachments/{subject.name.replace('/', '-')}"
        self._marks_path = path if subject.marks else None
        self._labels: list[viser.SceneNodeHandle] = []
        self.label_names: list[str] = []
        if self._marks_path:
            places = np.array([mark.position for mark in subject.marks])
            part = MeshPart("marks", *octahedra(places, MARK_RADIUS * size), Material(BLUE))
            driver.add(path, glb(surface((part,))), len(part.vertices))
            self._label(subject.marks)

    def _label(self, marks: Sequence[Mark]) -> None:
        for number, mark in enumerate(marks[:MOST_LABELS]):
            place = f"{self._marks_path}/{number}"
            frame = self._scene.add_frame(place, show_axes=False, position=mark.position)
            name, text = f"{place}/name", cut(mark.name, LABEL_LETTERS)
            self._scene.add_label(name, text, anchor="center-center", font_screen_scale=0.85)
            self._labels.append(frame)
            self.label_names.append(name)

    @property
    def path(self) -> str | None:
        """Of its surface; None if it has none."""
        return self._body.path if self._body else None

    def scale(self, q: Array, size: float) -> float:
        """Return the factor that draws a motion in its coordinates clearly."""
        if self._body:
            return default_amplitude([self._body.displacement(q)], [self._body.areas], size)
        moved = [mark.shapes @ q for mark in self.subject.marks]
        largest = float(np.abs(moved).max()) if moved else 0.0
        return DRAWN_FRACTION * size / largest if largest else 0.0

    def at_rest(self) -> dict[str, Array]:
        """Return what the driver shows of it while something else moves."""
        paths = (self.path, self._marks_path)
        return {path: AT_REST for path in paths if path}

    def points(self, q: Array) -> dict[str, Array]:
        """Return what the driver shows of a motion in its coordinates."""
        points = {}
        if self._body:
            points |= self._body.points(self._body.displacement(q), q, None)
        if self._marks_path:
            moved = np.array([mark.shapes @ q for mark in self.subject.marks])
            points[self._marks_path] = np.repeat(moved, 6, axis=0)
        return points

    def show(self, visible: bool, ghost: bool, marks: bool, names: bool) -> None:
        """Draws it or leaves it out, and its outlines, attachments and their names."""
        if self._body:
            self._body.show(visible, see_through=False, ghost=ghost)
        if self._marks_path:
            self._driver.set_visible(self._marks_path, visible and marks)
        for label in self._labels:
            assign(label, visible=visible and names)

    def remove(self) -> None:
        """Takes it out of the scene."""
        if self._body:
            self._body.remove()
        for label in self._labels:
            label.remove()
        if self._marks_path:
            self._driver.remove(self._marks_path)


class InspectionScene:
    """Draws states; the meshes are made anew when there is something else to look at."""

    def __init__(self, server: Server, dark: bool) -> None:
        """Sets an empty stage."""
        self._server, self._theme = server, DARK if dark else LIGHT
        self._box = EMPTY
        self._stage = Stage(server.scene, self._box, self._theme)
        self.driver: ShapeDriver = ShapeDriver(server.scene)
        self._cameras = Cameras(server, self._box)
        self._content: Content | None = None
        self._drawn: list[DrawnSubject] = []

    def show(self, state: State) -> None:
        """Draws a state."""
        with self._server.atomic():
            if state.content is not self._content:
                self._draw(state.content)
            self._move(state)
            self._stage.light(colored=state.coloring != "bodies")
            for drawn in self._drawn:
                moves = drawn.subject.name == state.subject
                has_marks = state.attachments
                drawn.show(
                    moves or not state.alone, moves and state.outlines, has_marks, moves and has_marks
                )
        self._cameras.frame(self._box)

    def look(self, client: viser.ClientHandle, view: str) -> None:
        """Turns a page's camera to one of `stage.VIEWS`."""
        self._cameras.look(client, view)

    def _draw(self, content: Content) -> None:
        for drawn in self._drawn:
            drawn.remove()
        self._content, self._box = content, _box(content.subjects)
        self._stage.lay_ground(self._box, self._box.low[2])
        self._drawn = [
            DrawnSubject(self._server.scene, self.driver, subject, self._theme, self._box.length)
            for subject in content.subjects
        ]
        labels = [name for drawn in self._drawn for name in drawn.label_names]
        keep_apart(self._server.scene, labels, f"{NO_CARD}/text", f"{NO_CARD}/line", self._theme)

    def _move(self, state: State) -> None:
        """Sends the shape of what moves, scaled so that it is clear to see, and its colours."""
        points, shades = {}, {}
        for drawn in self._drawn:
            subject = drawn.subject
            if subject.name != state.subject or not subject.modes:
                points |= drawn.at_rest()
                continue
            q = subject.coordinates(state.mode)
            moved = drawn.points(q * drawn.scale(q, self._box.length))
            points |= {path: _sendable(shape) for path, shape in moved.items()}
            if state.coloring == "displacement" and drawn.path:
                shades[drawn.path] = displacement_shade(DRAWN_FRACTION * self._box.length)
        self.driver.show(points)
        self.driver.shade(shades)


def _sendable(shape: Array) -> Array:
    """A shape no part of which is too large to be sent."""
    largest = float(np.abs(shape).max(initial=0.0))
    return shape if largest <= LARGEST else shape * (LARGEST / largest)


def _box(subjects: Sequence[Subject]) -> Box:
    points: list[Floats] = [subject.drawn.vertices for subject in subjects]
    points += [mark.position[None] for subject in subjects for mark in subject.marks]
    return points_box(points) if any(len(p) for p in points) else EMPTY
