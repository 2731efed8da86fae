from dataclasses import replace

import numpy as np
import pytest
from small_meshes import BAR, STEEL, bar, plate

from modeviz.errors import VehicleError, kind_of
from modeviz.fem.mesh import FiniteElementMesh, PointMass, ShellSection


@pytest.mark.parametrize(
    ("section", "field", "value"),
    [
        (ShellSection(0.001, **STEEL), "thickness", 0.0),
        (ShellSection(0.001, **STEEL), "bending_factor", -1.0),
        (ShellSection(0.001, **STEEL), "added_mass", -1.0),
        (ShellSection(0.001, **STEEL), "poisson_ratio", 0.5),
        (BAR, "area", np.nan),
        (BAR, "torsion_constant", 0.0),
        (BAR, "added_mass", np.inf),
        (PointMass(0, 1.0), "mass", 0.0),
        (PointMass(0, 1.0), "inertia", (1.0, -1.0, 1.0)),
    ],
)
def test_impossible_section_is_refused_by_the_name_of_its_field(section, field, value):
    with pytest.raises(VehicleError, match=f"^{kind_of(section)}: {field}: found"):
        replace(section, **{field: value})


def one_quad(corners):
    return FiniteElementMesh(
        np.array(corners, float), np.array([[0, 1, 2, 3]]), (ShellSection(0.001, **STEEL),)
    )


@pytest.mark.parametrize(
    "corners",
    [
        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 0)],  # two corners at one place
        [(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)],  # crossed sides
        [(0, 0, 0), (1, 0, 0), (0.2, 0.2, 0), (0, 1, 0)],  # a dent
        [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)],  # no area
    ],
)
def test_quad_that_is_not_convex_is_refused(corners):
    with pytest.raises(VehicleError, match=r"quad 0 with nodes \[0, 1, 2, 3\].*convex"):
        one_quad(corners)


def test_warped_quad_is_accepted():
    assert len(one_quad([(0, 0, 0), (1, 0, 0), (1, 1, 0.3), (0, 1, 0)]).quads) == 1


def test_beam_without_length_is_refused():
    mesh = bar(n=2)
    nodes = mesh.nodes.copy()
    nodes[2] = nodes[1]
    with pytest.raises(VehicleError, match="beam 1 with nodes"):
        replace(mesh, nodes=nodes)


def test_beam_whose_up_runs_along_it_is_refused():
    with pytest.raises(VehicleError, match="beam 0 with nodes"):
        bar(up=(2.0, 0.0, 0.0))


def test_node_that_does_not_exist_is_refused():
    with pytest.raises(VehicleError, match="beam 0: found node 9, expected 0 to 2"):
        replace(bar(n=2), beams=np.array([[0, 9], [1, 2]]))


def test_point_mass_on_a_node_that_does_not_exist_is_refused():
    with pytest.raises(VehicleError, match="point mass 0: found node -1, expected 0 to 2"):
        replace(bar(n=2), point_masses=(PointMass(-1, 1.0),))


def test_node_that_nothing_holds_is_refused():
    mesh = bar(n=2)
    with pytest.raises(VehicleError, match=r"node 3 at \[5.0, 5.0, 5.0\]"):
        replace(mesh, nodes=np.vstack([mesh.nodes, [[5.0, 5.0, 5.0]]]))


def test_every_element_needs_a_section():
    with pytest.raises(VehicleError, match="found 3 quad sections, expected 4"):
        replace(plate(2), quad_sections=plate(2).quad_sections[:3])


def test_mesh_is_read_only():
    assert not plate(1).nodes.flags.writeable
    assert not plate(1).quads.flags.writeable
