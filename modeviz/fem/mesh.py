"""A shell and beam mesh as data: what `component` turns into matrices."""

from dataclasses import dataclass, field

import numpy as np

from modeviz.vehicle.arrays import Floats


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
