"""Shell and beam elements: the one module that knows pyfe3d."""

from collections.abc import Sequence

import numpy as np
from pyfe3d import BeamC, BeamCData, BeamCProbe, Quad4R, Quad4RData, Quad4RProbe
from pyfe3d.beamprop import BeamProp
from pyfe3d.shellprop import ShellProp
from pyfe3d.shellprop_utils import isotropic_plate

from modeviz.fem.mesh import BeamSection, ShellSection
from modeviz.vehicle.arrays import Floats

TUBE_SHEAR_FACTOR = 0.4
"""Shear area over area of a thin-walled tube; Cowper (1966) has 0.44 for a square one."""


def shell_matrices(corners: Floats, sections: Sequence[ShellSection]) -> tuple[Floats, Floats]:
    """Stiffness and consistent mass of `Quad4R` shells, two arrays (n_quads, 24, 24).

    Bilinear Mindlin shell with one point of integration, hourglass control and drilling stiffness.
    A warped one resists rigid rotation a little: `matrices` frees it.

    Args:
        corners: (n_quads, 4, 3), m, around each quadrilateral.
        sections: one for each quad.
    """
    K, M = np.zeros((2, len(corners), 24, 24))
    quad, data = Quad4R(Quad4RProbe()), Quad4RData()
    properties = {section: _shell_property(section) for section in set(sections)}
    quad.c1, quad.c2, quad.c3, quad.c4 = 0, 6, 12, 18
    for i, (corner, section) in enumerate(zip(corners, sections, strict=True)):
        x = np.array(corner, float).ravel()
        prop = properties[section]
        quad.update_rotation_matrix(x)
        quad.update_probe_xe(x)
        _dense(quad.update_KC0, data.KC0_SPARSE_SIZE, prop, K[i])
        _dense(quad.update_M, data.M_SPARSE_SIZE, prop, M[i])
    return K, M


def beam_matrices(ends: Floats, up: Floats, sections: Sequence[BeamSection]) -> tuple[Floats, Floats]:
    """Stiffness and consistent mass of `BeamC` beams, two arrays (n_beams, 12, 12).

    Timoshenko beam with exact static shape functions.

    Args:
        ends: (n_beams, 2, 3), m.
        up: (n_beams, 3), spans with the axis the plane of `bending_inertia_up`.
        sections: one for each beam.
    """
    K, M = np.zeros((2, len(ends), 12, 12))
    beam, data = BeamC(BeamCProbe()), BeamCData()
    properties = {section: _beam_property(section) for section in set(sections)}
    beam.c1, beam.c2 = 0, 6
    for i, (end, section) in enumerate(zip(ends, sections, strict=True)):
        x = np.array(end, float).ravel()
        prop = properties[section]
        # pyfe3d wants its y axis, and z = x × y: so z is up.
        beam.update_rotation_matrix(*np.cross(up[i], end[1] - end[0]), x)
        beam.update_probe_xe(x)
        _dense(beam.update_KC0, data.KC0_SPARSE_SIZE, prop, K[i])
        _dense(beam.update_M, data.M_SPARSE_SIZE, prop, M[i])
    return K, M


def _dense(update, size: int, prop: ShellProp | BeamProp, out: Floats) -> None:
    """Adds the triplets that `update` writes to the matrix `out`."""
    rows, columns = np.zeros((2, size), np.int64)
    values = np.zeros(size)
    update(rows, columns, values, prop, 0)
    np.add.at(out, (rows, columns), values)


def _shell_property(section: ShellSection) -> ShellProp:
    """The laminate of a sheet, swages smeared over it.

    They multiply bending stiffness and rotary inertia, and shear stiffness by the square root, as the
    depth of the section grows.
    """
    prop = isotropic_plate(
        thickness=section.thickness,
        E=section.youngs_modulus,
        nu=section.poisson_ratio,
        rho=section.density,
    )
    for name in ("D11", "D12", "D16", "D22", "D26", "D66"):
        setattr(prop, name, getattr(prop, name) * section.bending_factor)
    for name in ("A44", "A45", "A55"):
        setattr(prop, name, getattr(prop, name) * max(1.0, section.bending_factor**0.5))
    prop.intrhoz2 *= section.bending_factor
    prop.intrho += section.added_mass
    return prop


def _beam_property(section: BeamSection) -> BeamProp:
    shear_modulus = section.youngs_modulus / (2 * (1 + section.poisson_ratio))
    prop = BeamProp()
    prop.A = section.area
    prop.E = section.youngs_modulus
    prop.G12 = prop.G13 = TUBE_SHEAR_FACTOR * shear_modulus
    prop.GJ = shear_modulus * section.torsion_constant
    prop.Iyy = section.bending_inertia_up
    prop.Izz = section.bending_inertia_across
    prop.intrho = section.density * section.area + section.added_mass
    prop.intrhoy2 = section.density * section.bending_inertia_across
    prop.intrhoz2 = section.density * section.bending_inertia_up
    return prop
