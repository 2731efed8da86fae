"""What the page of bodies shows of one: its surface, how that moves, its modes and attachments."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from modeviz.formats.body import uncoupled_because
from modeviz.formats.component import Component, UnitSystem
from modeviz.formats.surface import COLOR, POINT, display_mesh
from modeviz.shapes.motion import vertex_shapes
from modeviz.shapes.points import octahedra
from modeviz.shapes.stand_in import drawn_mesh
from modeviz.shapes.surface import Surface, surface
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Body, FlexibleBody, Material, Mesh, MeshPart
from modeviz.vehicle.carriers import carried_by_nodes
from modeviz.vehicle.mesh_doubts import coarser_words

STILL_HZ = 0.1
"""Below this a body alone moves as a rigid one, or nearly."""

MOST_CARRIERS = 2_000_000
"""Nodes times coordinates that carry the drawing, 48 MB: more nodes are thinned out."""

UNKNOWN = float("nan")


@dataclass(frozen=True)
class ListedMode:
    """A mode as it is listed; not a number is what nobody says."""

    kind: str
    """Such as "rigid mode"."""
    frequency_hz: float
    damping_ratio: float = UNKNOWN
    modal_mass: float = UNKNOWN
    """In the units of the file."""


@dataclass(frozen=True, eq=False)
class Mark:
    """An attachment."""

    name: str
    position: Floats
    """(3,), m."""
    shapes: Floats
    """(3, n_coordinates): how it moves."""


@dataclass(frozen=True, eq=False)
class Subject:
    """A body in modes of its own; its coordinates are these, or their real and imaginary parts."""

    name: str
    drawn: Surface
    """In m; of a file that does not say its units as large as one metre."""
    shapes: NDArray[np.float32]
    """(n_coordinates, n_vertices, 3)."""
    modes: tuple[ListedMode, ...]
    is_complex: bool
    marks: tuple[Mark, ...]
    about: tuple[str, ...]
    """What else to know, a sentence each."""

    @property
    def n_coordinates(self) -> int:
        """How many coordinates it has."""
        return len(self.modes) * (2 if self.is_complex else 1)

    def coordinates(self, mode: int) -> Array:
        """Return the coordinates of one of its modes, (n_coordinates,), complex if its shapes are."""
        q = np.zeros(self.n_coordinates, complex if self.is_complex else float)
        q[mode] = 1
        if self.is_complex:
            q[len(self.modes) + mode] = 1j
        return q

    @cached_property
    def first_shown(self) -> int:
        """The mode that is worth to be seen first: the lowest that deforms it."""
        return next((i for i, m in enumerate(self.modes) if m.frequency_hz > STILL_HZ), 0)


def subject_of_component(component: Component, name: str, units: UnitSystem | None) -> Subject:
    """Return a component of another program's files as it is looked at.

    Args:
        component: any, held or free, real or complex, with modal masses or without.
        name: to call it.
        units: that it is in, if anybody knows.
    """
    placed = component.nodes[component.has_place]
    extent = float(np.ptp(placed, axis=0).max()) if len(placed) else 0.0
    length = units.length if units else 1 / extent if extent else 1.0
    mesh, carriers = display_mesh(component, length)
    drawn = surface(mesh)
    rows = carriers[:: -(-len(carriers) * max(component.n_modes, 1) // MOST_CARRIERS) or 1]
    motions = _real_motions(component.modes.shapes[rows], length)
    shapes = np.zeros((motions.shape[2], 0, 3), np.float32)
    if len(drawn.vertices):
        shapes = carried_by_nodes(component.nodes[rows] * length, motions, drawn.vertices)
    modes = component.modes
    kind = "complex mode" if component.is_complex else "mode"
    kinds = [kind] * (component.n_modes - modes.n_residuals) + ["residual vector"] * modes.n_residuals
    listed = [
        ListedMode(*values)
        for values in zip(
            kinds,
            modes.frequency_hz.tolist(),
            modes.damping_ratio.tolist(),
            modes.modal_mass.tolist(),
            strict=True,
        )
    ]
    about = (*_about_component(component, units), *_coarser(mesh))
    return Subject(name, drawn, shapes, tuple(listed), component.is_complex, (), about)


def _real_motions(shapes: Array, length: float) -> NDArray[np.float32]:
    """Motions of nodes in m, the imaginary parts after the real ones, (n_nodes, 6, n_coordinates)."""
    parts = (np.real(shapes), np.imag(shapes)) if np.iscomplexobj(shapes) else (shapes,)
    motions = np.concatenate(parts, axis=2)
    size = np.abs(motions).max(initial=0.0) or 1.0  # of any size in a file, singles must hold them
    motions = (motions / size).astype(np.float32)
    motions[:, :3] *= length
    return motions


def _about_component(component: Component, units: UnitSystem | None) -> Iterator[str]:
    counts = [
        f"{len(c):,} {kind}{'s' if len(c) != 1 else ''}" for kind, c in component.elements.items()
    ]
    yield f"{len(component.node_ids):,} nodes, {', '.join(counts) or 'no elements'}."
    yield f"Units: {units.name if units else 'the file does not say them'}."
    yield from (f"{note[:1].upper()}{note[1:]}." for note in component.notes)
    reason = uncoupled_because(component)
    yield f"It cannot be coupled to others: {reason}." if reason else "It can be coupled to others."


def subject_of_body(body: Body) -> Subject:
    """Return a body of a vehicle as it is looked at; a rigid one has no modes."""
    drawn = surface(drawn_mesh(body) or _nodes_mesh(body))
    if not isinstance(body, FlexibleBody):
        still = np.zeros((0, len(drawn.vertices), 3), np.float32)
        about = (_weight(body), *_coarser(body.mesh))
        return Subject(body.name, drawn, still, (), False, (), about)
    marks = tuple(Mark(a.name, a.position, a.shapes[:3]) for a in body.attachments)
    about = (_weight(body), _attached(marks), *_coarser(body.mesh))
    modes = tuple(_modes_of(body))
    return Subject(body.name, drawn, vertex_shapes(body, drawn.vertices), modes, False, marks, about)


def _coarser(mesh: Mesh) -> Iterator[str]:
    if words := coarser_words(mesh):
        yield f"Its surface {words}."


def _nodes_mesh(body: Body) -> Mesh:
    """The nodes of a body that has no mesh, if it has any."""
    nodes = body.nodes if isinstance(body, FlexibleBody) else np.zeros((0, 3))
    size = float(np.ptp(nodes, axis=0).max()) if len(nodes) else 0.0
    return (MeshPart("nodes", *octahedra(nodes, POINT * size), Material(COLOR)),) if size else ()


def _modes_of(body: FlexibleBody) -> Iterator[ListedMode]:
    kinds = ["rigid mode"] * body.n_rigid + ["mode"] * (body.n_normal - body.n_rigid)
    kinds += ["residual vector"] * body.n_residuals
    ratios = body.damping_ratios.tolist()
    for kind, frequency, ratio in zip(kinds, body.natural_frequency_hz.tolist(), ratios, strict=True):
        yield ListedMode(kind, frequency, ratio)


def _weight(body: Body) -> str:
    if isinstance(body, FlexibleBody):
        x, y, z = body.center_of_gravity
        return f"{body.mass:.4g} kg by its modes, centre of gravity [{x:.3f}, {y:.3f}, {z:.3f}] m."
    x, y, z = body.center_of_gravity
    return f"Rigid, {body.mass:.4g} kg, centre of gravity [{x:.3f}, {y:.3f}, {z:.3f}] m."


def _attached(marks: Sequence[Mark]) -> str:
    if not marks:
        return "No attachments, so nothing can hold on to it."
    return f"{len(marks)} attachment{'s' if len(marks) != 1 else ''}."
