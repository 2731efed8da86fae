"""Two runs of one half of a structure, symmetric and antisymmetric, joined to the whole.

What a plane of symmetry mirrors moves either as its image or against it. A half that is held so at the
plane has the modes of the whole that are so, and half their modal mass (A. E. Duncan analyses the
components of his truck as halves: "one-half of each component was modeled", with "the appropriate
boundary condition along the centerline").
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeviz.errors import VehicleError, quoted
from modeviz.files.modal import with_zeros
from modeviz.formats.attachments import Found
from modeviz.formats.component import Component, ElementKind, Modes
from modeviz.vehicle.arrays import Array, Floats

IN_PLANE = 1e-5
"""How far from the plane a node in it may be, a part of the size of the half."""

STILL = 1e-4
"""What is held at the plane moves less than this part of the largest motion."""

LARGEST_ID = 10**17
"""Of nodes that get images."""

ALIKE = 0.8
"""Modes of both runs reach as far if one's highest is above this part of the other's."""

N_RIGID = 3
"""How many rigid modes each half has."""

MIRRORED: Mapping[ElementKind, tuple[int, ...]] = {
    "line": (0, 1), "triangle": (0, 2, 1), "quad": (0, 3, 2, 1), "tetra": (0, 2, 1, 3),
    "pyramid": (0, 3, 2, 1, 4), "wedge": (0, 2, 1, 3, 5, 4), "hexa": (0, 3, 2, 1, 4, 7, 6, 5),
}  # fmt: skip
"""The corners of an element's image, in an order that leaves its faces outside."""


@dataclass(frozen=True)
class Plane:
    """Where a structure is cut in two."""

    axis: int
    """0 to 2: x, y or z, across it."""
    at: float = 0.0
    """In the file's units."""

    def __str__(self) -> str:
        return f"{'xyz'[self.axis]} = {self.at:g}"

    @property
    def signs(self) -> Floats:
        """(6,): what motions along and about x, y and z are multiplied by in the image."""
        along = np.where(np.arange(3) == self.axis, -1.0, 1.0)
        return np.r_[along, -along]

    def image(self, places: Floats) -> Floats:
        """Return where the images of places are, (n, 3)."""
        there = np.array(places, float)
        there[:, self.axis] = 2 * self.at - there[:, self.axis]
        return there


def parse_plane(text: str) -> Plane:
    """Return the plane that is written as "y" or "y=0"; raises VehicleError if it is neither."""
    axis, _, at = text.replace(" ", "").lower().partition("=")
    try:
        plane = Plane("xyz".index(axis) if len(axis) == 1 else -1, float(at or 0.0))
    except ValueError:
        plane = Plane(-1)
    if plane.axis < 0 or not np.isfinite(plane.at):
        raise VehicleError(f"found {quoted(text)}, expected such as y=0, in the file's units")
    return plane


@dataclass(frozen=True, eq=False)
class Whole:
    """A structure made of its half."""

    component: Component
    image: Array
    """(n_nodes,): which node is the image of each; itself of those in the plane."""
    plane: Plane

    def attachments(self, found: Sequence[Found], left: Floats, length: float) -> tuple[Found, ...]:
        """Return attachments and their images; those that are their own image are there once.

        Of the others the name says "left" or "right", and "image" of the second if the plane does not
        part left from right.

        Args:
            found: in SI, of nodes of the half.
            left: (3,), which way left is in the component's axes.
            length: m of one of the component's units.
        """
        plane = replace(self.plane, at=self.plane.at * length)
        across, size = left[plane.axis], _size(self.component.nodes) * length
        return tuple(each for one in found for each in self._pair(one, plane, across, size))

    def _pair(self, one: Found, plane: Plane, across: float, length: float) -> tuple[Found, ...]:
        position = plane.image(one.position[None])[0]
        is_own = np.array_equal(np.sort(self.image[one.rows]), np.sort(one.rows))
        if is_own and np.allclose(position, one.position, rtol=0, atol=IN_PLANE * length):
            return (one,)
        n = len(one.rows)
        motion = plane.signs[:, None, None] * one.motion.reshape(6, n, 6) * plane.signs
        image = replace(
            one, position=position, rows=self.image[one.rows], motion=motion.reshape(6, 6 * n)
        )
        if abs(across) < 0.5:
            return one, replace(image, name=f"{one.name} image")
        is_left = (one.position[plane.axis] - plane.at) * across > 0
        sides = ("left", "right") if is_left else ("right", "left")
        return tuple(
            replace(each, name=f"{one.name} {side}")
            for each, side in zip((one, image), sides, strict=True)
        )


def join_halves(symmetric: Component, antisymmetric: Component, plane: Plane) -> Whole:
    """Return the whole structure of two runs of one half.

    A node has its own motion, and its image that mirrored, or that against it; the modal mass is twice
    the half's, so that mass-normalised shapes are those of the half by √2. New nodes have numbers above
    those of the half.

    Raises:
        VehicleError: they are not of one half beside the plane, or not held at it as they are named.
    """
    halves = {"symmetric": symmetric, "antisymmetric": antisymmetric}
    _check_modes(halves)
    nodes = _common_nodes(symmetric, antisymmetric)
    in_plane = _in_plane(nodes, plane)
    for name, half in halves.items():
        _check_held(name, half, in_plane, plane)
        _check_rigid(name, half)
    n = len(nodes)
    image = np.arange(n)
    image[~in_plane] = n + np.arange(np.sum(~in_plane))
    own = np.flatnonzero(~in_plane)
    ids = symmetric.node_ids
    step = 10 ** len(str(int(ids.max())))
    component = Component(
        np.r_[ids, step + ids[own]],
        np.vstack([nodes, plane.image(nodes[own])]),
        _elements(symmetric.elements, image, in_plane),
        _modes(symmetric.modes, antisymmetric.modes, plane, own),
        symmetric.units or antisymmetric.units,
        tuple(dict.fromkeys((*symmetric.notes, *antisymmetric.notes, *_reach_notes(halves)))),
        source=f"{symmetric.source} and {antisymmetric.source}",
        node_sets=symmetric.node_sets,
    )
    return Whole(component, np.r_[image, own], plane)


def _check_modes(halves: Mapping[str, Component]) -> None:
    """Raises VehicleError unless both have real modes, with masses."""
    for name, half in halves.items():
        where = f"the {name} run, {half.source}"
        if half.matrices is not None:
            raise VehicleError(f"{where}: has matrices; halves are joined by their modes")
        if not half.n_modes:
            raise VehicleError(f"{where}: has no modes")
        if half.is_complex:
            raise VehicleError(f"{where}: has complex modes, expected normal ones")
        if not half.has_place.all():
            raise VehicleError(f"{where}: moves nodes that have no place; give the file with them too")


def _common_nodes(symmetric: Component, antisymmetric: Component) -> Floats:
    """The places of the nodes of both, (n, 3)."""
    ids, others = symmetric.node_ids, antisymmetric.node_ids
    if not np.array_equal(ids, others):
        alone = np.setxor1d(ids, others)
        raise VehicleError(
            f"the two runs are not of one half: {len(alone)} nodes are in one of them alone, such as "
            f"node {alone[0]}"
        )
    if ids[-1] >= LARGEST_ID:
        raise VehicleError(f"node {ids[-1]} has too large a number for its image to have one above it")
    apart = np.linalg.norm(symmetric.nodes - antisymmetric.nodes, axis=1)
    if apart.max() > IN_PLANE * _size(symmetric.nodes):
        raise VehicleError(
            f"the two runs are not of one half: node {ids[apart.argmax()]} is at two places, "
            f"{apart.max():.3g} apart"
        )
    return symmetric.nodes


def _size(nodes: Floats) -> float:
    return float(np.ptp(nodes, axis=0).max())


def _in_plane(nodes: Floats, plane: Plane) -> Array:
    """Which nodes are in the plane."""
    beyond = nodes[:, plane.axis] - plane.at
    near = IN_PLANE * _size(nodes)
    if beyond.min() < -near and beyond.max() > near:
        raise VehicleError(
            f"the half is on both sides of the plane {plane}, from {beyond.min():.6g} to "
            f"{beyond.max():.6g}, expected on one; say where it is cut with --plane"
        )
    if not (in_plane := np.abs(beyond) <= near).any():
        raise VehicleError(
            f"no node is in the plane {plane}, the nearest is {np.abs(beyond).min():.6g} away; say "
            "where the half is cut with --plane"
        )
    return in_plane


def _check_held(name: str, half: Component, in_plane: Array, plane: Plane) -> None:
    """Raises VehicleError unless nodes in the plane have no motion that a run holds."""
    sign = 1 if name == "symmetric" else -1
    held = np.flatnonzero(plane.signs * sign < 0)
    shapes = half.modes.shapes
    turns = np.repeat([1.0, _size(half.nodes)], 3)
    largest = max(float(np.abs(shapes[:, i]).max()) * turns[i] for i in range(6))
    for i in held:
        moved = np.abs(shapes[in_plane, i]).max(axis=1) * turns[i]
        if moved.max() > STILL * largest:
            node = half.node_ids[in_plane][moved.argmax()]
            directions = ", ".join(("x", "y", "z", "rx", "ry", "rz")[i] for i in held)
            raise VehicleError(
                f"the {name} run, {half.source}, moves node {node} in the plane {plane} along "
                f"{['x', 'y', 'z', 'rx', 'ry', 'rz'][i]}; expected it held there in {directions} "
                f"(SPC {''.join(str(i + 1) for i in held)}); are the runs exchanged?"
            )


def _check_rigid(name: str, half: Component) -> None:
    frequency = half.modes.frequency_hz
    squares, _ = with_zeros((2 * np.pi) ** 2 * frequency * np.abs(frequency))
    n_rigid = int((squares == 0).sum())
    if n_rigid != N_RIGID:
        raise VehicleError(
            f"the {name} run, {half.source}, has {n_rigid} modes near zero Hz, expected the three "
            "rigid ones of a half that is held at the plane alone: all modes from zero up"
        )


def _reach_notes(halves: Mapping[str, Component]) -> Iterator[str]:
    """A sentence if one run's modes end far below the other's."""
    tops = {
        name: float(half.modes.frequency_hz[half.n_modes - half.modes.n_residuals - 1])
        for name, half in halves.items()
    }
    lower, higher = sorted(tops, key=tops.__getitem__)
    if tops[lower] < ALIKE * tops[higher]:
        yield (
            f"the modes of the {lower} run end at {tops[lower]:.4g} Hz, those of the {higher} one at "
            f"{tops[higher]:.4g} Hz: between them half of the whole's are missing"
        )


def _elements(
    elements: Mapping[ElementKind, Array], image: Array, in_plane: Array
) -> dict[ElementKind, Array]:
    """Those of the half and their images, but of what is in the plane."""
    return {
        kind: np.vstack([corners, image[corners[~in_plane[corners].all(axis=1)]][:, MIRRORED[kind]]])
        for kind, corners in elements.items()
    }


def _modes(symmetric: Modes, antisymmetric: Modes, plane: Plane, own: Array) -> Modes:
    """The modes of both on all nodes, those that are no residual vectors first, by frequency."""
    signs = plane.signs.astype(symmetric.shapes.dtype)[:, None]
    parts = [
        np.concatenate([half.shapes, sign * signs * half.shapes[own]])
        for half, sign in ((symmetric, 1), (antisymmetric, -1))
    ]
    halves = (symmetric, antisymmetric)
    frequency = np.concatenate([half.frequency_hz for half in halves])
    is_residual = np.concatenate(
        [np.arange(len(h.frequency_hz)) >= len(h.frequency_hz) - h.n_residuals for h in halves]
    )
    order = np.lexsort((frequency, is_residual))
    return Modes(
        frequency[order],
        2 * np.concatenate([half.modal_mass for half in halves])[order],
        np.concatenate([half.damping_ratio for half in halves])[order],
        np.concatenate(parts, axis=2)[:, :, order],
        int(is_residual.sum()),
    )
