"""A shell and beam mesh as data: what `matrices` assembles."""

from dataclasses import dataclass, field

import numpy as np

from modeviz.errors import VehicleError, kind_of
from modeviz.vehicle.arrays import Floats, frozen

FLAT = 1e-3
"""Sine of the angle below which two directions count as one."""


@dataclass(frozen=True)
class ShellSection:
    """An isotropic sheet."""

    thickness: float
    """m."""
    youngs_modulus: float
    """Pa."""
    poisson_ratio: float
    density: float
    """kg/m³."""
    bending_factor: float = 1.0
    """12 I / t³: how much stiffer in bending than a flat sheet, because it is swaged or ribbed."""
    added_mass: float = 0.0
    """Non-structural mass, kg/m²."""

    def __post_init__(self) -> None:
        _check_positive(self, "thickness", "youngs_modulus", "density", "bending_factor")
        _check_not_negative(self, added_mass=self.added_mass)
        _check_poisson_ratio(self, self.poisson_ratio)


@dataclass(frozen=True)
class BeamSection:
    """A prismatic beam."""

    area: float
    """m²."""
    bending_inertia_up: float
    """m⁴, for bending in the plane of the beam's axis and its `up` direction."""
    bending_inertia_across: float
    """m⁴, for bending across it."""
    torsion_constant: float
    """m⁴."""
    youngs_modulus: float
    """Pa."""
    poisson_ratio: float
    density: float
    """kg/m³."""
    added_mass: float = 0.0
    """Non-structural mass, kg/m."""

    def __post_init__(self) -> None:
        _check_positive(self, "area", "bending_inertia_up", "bending_inertia_across")
        _check_positive(self, "torsion_constant", "youngs_modulus", "density")
        _check_not_negative(self, added_mass=self.added_mass)
        _check_poisson_ratio(self, self.poisson_ratio)


@dataclass(frozen=True)
class PointMass:
    """A lump fixed to a node."""

    node: int
    mass: float
    """kg."""
    offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """From the node to the lump's centre, m."""
    inertia: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """About its own centre, kg m²."""

    def __post_init__(self) -> None:
        _check_positive(self, "mass")
        _check_not_negative(self, inertia=min(self.inertia))


@dataclass(frozen=True, eq=False)
class FiniteElementMesh:
    """Nodes with six degrees of freedom each, joined by shells and beams."""

    nodes: Floats
    """(n_nodes, 3), m."""
    quads: np.ndarray = field(default_factory=lambda: np.zeros((0, 4), int))
    """(n_quads, 4), node indices around each quadrilateral."""
    quad_sections: tuple[ShellSection, ...] = ()
    """One for each quad."""
    beams: np.ndarray = field(default_factory=lambda: np.zeros((0, 2), int))
    """(n_beams, 2), node indices."""
    beam_sections: tuple[BeamSection, ...] = ()
    """One for each beam."""
    beam_up: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    """(n_beams, 3): a direction that with the axis spans the plane of `bending_inertia_up`."""
    point_masses: tuple[PointMass, ...] = ()

    def __post_init__(self) -> None:
        frozen(self, "nodes", self.nodes, (None, 3))
        frozen(self, "quads", self.quads, (None, 4), int)
        frozen(self, "beams", self.beams, (None, 2), int)
        frozen(self, "beam_up", self.beam_up, (len(self.beams), 3))
        self._check_one_section_each("quad", len(self.quads), self.quad_sections)
        self._check_one_section_each("beam", len(self.beams), self.beam_sections)
        held_by_points = np.array([[p.node] for p in self.point_masses], int).reshape(-1, 1)
        for kind, nodes in ("quad", self.quads), ("beam", self.beams), ("point mass", held_by_points):
            self._check_nodes_exist(kind, nodes)
        self._check_every_node_is_held()
        self._check_quads_are_convex()
        self._check_beams_have_a_plane()

    def _check_one_section_each(self, kind: str, n_elements: int, sections: tuple) -> None:
        if len(sections) != n_elements:
            raise VehicleError(f"mesh: found {len(sections)} {kind} sections, expected {n_elements}")

    def _check_nodes_exist(self, kind: str, nodes: np.ndarray) -> None:
        wrong = np.argwhere((nodes < 0) | (nodes >= len(self.nodes)))
        if len(wrong):
            element, corner = wrong[0]
            raise VehicleError(
                f"mesh: {kind} {element}: found node {nodes[element, corner]}, "
                f"expected 0 to {len(self.nodes) - 1}"
            )

    def _check_every_node_is_held(self) -> None:
        loose = np.setdiff1d(np.arange(len(self.nodes)), np.r_[self.quads.ravel(), self.beams.ravel()])
        if len(loose):
            raise VehicleError(
                f"mesh: node {loose[0]} at {self.nodes[loose[0]].tolist()} belongs to no shell or "
                f"beam, so nothing holds it ({len(loose)} such nodes)"
            )

    def _check_quads_are_convex(self) -> None:
        corners = self.nodes[self.quads]
        sides = np.roll(corners, -1, axis=1) - corners
        before = np.roll(sides, 1, axis=1)
        facing = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        facing = facing / np.maximum(
            np.linalg.norm(facing, axis=1, keepdims=True), np.finfo(float).tiny
        )
        turn = np.einsum("eci,ei->ec", np.cross(before, sides), facing)
        least = FLAT * np.linalg.norm(before, axis=2) * np.linalg.norm(sides, axis=2)
        wrong = np.argwhere(turn <= least)
        if len(wrong):
            raise VehicleError(
                f"mesh: quad {wrong[0, 0]} with nodes {self.quads[wrong[0, 0]].tolist()}: found sides "
                "that are folded, crossed or without length, expected a convex quadrilateral"
            )

    def _check_beams_have_a_plane(self) -> None:
        axes = np.diff(self.nodes[self.beams], axis=1)[:, 0]
        lengths = np.linalg.norm(axes, axis=1) * np.linalg.norm(self.beam_up, axis=1)
        wrong = np.flatnonzero(np.linalg.norm(np.cross(axes, self.beam_up), axis=1) <= FLAT * lengths)
        if len(wrong):
            raise VehicleError(
                f"mesh: beam {wrong[0]} with nodes {self.beams[wrong[0]].tolist()}: found no length or "
                "an up direction along it, expected one across"
            )


def _check_positive(owner: object, *fields: str) -> None:
    for field_name in fields:
        value = getattr(owner, field_name)
        if not (np.isfinite(value) and value > 0):
            raise VehicleError(f"{kind_of(owner)}: {field_name}: found {value}, expected more than 0")


def _check_not_negative(owner: object, **values: float) -> None:
    for field_name, value in values.items():
        if not (np.isfinite(value) and value >= 0):
            raise VehicleError(f"{kind_of(owner)}: {field_name}: found {value}, expected zero or more")


def _check_poisson_ratio(owner: object, value: float) -> None:
    if not -1 < value < 0.5:
        raise VehicleError(
            f"{kind_of(owner)}: poisson_ratio: found {value}, expected above -1 and below 0.5"
        )
