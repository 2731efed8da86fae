import numpy as np
import pytest
from small_meshes import BAR, STEEL, bar, grid

from modeviz.errors import SolveError
from modeviz.fem.elements import TUBE_SHEAR_FACTOR
from modeviz.fem.matrices import assemble
from modeviz.fem.mesh import BeamSection, FiniteElementMesh, ShellSection
from modeviz.fem.statics import beaming_stiffness, station, torsional_stiffness
from modeviz.units import factor

E, NU = STEEL["youngs_modulus"], STEEL["poisson_ratio"]
G = E / (2 * (1 + NU))


def test_beaming_of_a_beam_is_that_of_a_simply_supported_one():
    # 1 / (L³ / 48 EI + L / (4 k G A)), between supports that are not the ends.
    span = 1.6
    matrices = assemble(bar(n=20, length=2.0))
    found = beaming_stiffness(matrices, front=(2, 2), middle=(10, 10), rear=(18, 18))
    bending = span**3 / (48 * E * BAR.bending_inertia_up)
    shear = span / (4 * TUBE_SHEAR_FACTOR * G * BAR.area)
    np.testing.assert_allclose(found, 1 / (bending + shear), rtol=1e-9)


def test_beaming_off_the_middle_follows_the_lever():
    # a² b² / (3 EI L) + a b / (k G A L)
    a, b = 0.5, 1.5
    found = beaming_stiffness(assemble(bar(n=20, length=2.0)), (0, 0), (5, 5), (20, 20))
    bending = a**2 * b**2 / (3 * E * BAR.bending_inertia_up * 2.0)
    shear = a * b / (TUBE_SHEAR_FACTOR * G * BAR.area * 2.0)
    np.testing.assert_allclose(found, 1 / (bending + shear), rtol=1e-9)


def shaft_with_arms(arm=0.3, n=10, length=1.5):
    """A bar along x with stiff cross arms at its ends; nodes n+1 to n+4 are left, right at each."""
    rigid = BeamSection(1.0, 1.0, 1.0, 1.0, **STEEL)
    shaft = bar(n, length)
    tips = [[x, y, 0.0] for x in (0.0, length) for y in (-arm, arm)]
    arms = [[0, n + 1], [0, n + 2], [n, n + 3], [n, n + 4]]
    return FiniteElementMesh(
        np.vstack([shaft.nodes, tips]),
        beams=np.vstack([shaft.beams, arms]),
        beam_sections=shaft.beam_sections + (rigid,) * 4,
        beam_up=np.tile([0.0, 0.0, 1.0], (n + 4, 1)),
    )


def test_torsion_of_a_shaft_is_gj_over_length():
    mesh = shaft_with_arms()
    found = torsional_stiffness(assemble(mesh), front=(11, 12), rear=(13, 14))
    np.testing.assert_allclose(found, G * BAR.torsion_constant / 1.5, rtol=1e-5)


def test_stiffness_does_not_depend_on_which_side_is_called_left():
    matrices = assemble(shaft_with_arms())
    found = [torsional_stiffness(matrices, front, (13, 14)) for front in ((11, 12), (12, 11))]
    np.testing.assert_allclose(found[0], found[1], rtol=1e-9)


def box_tube(side=0.1, length=1.0, thickness=0.002, n=8):
    """A closed tube of square section with thick end plates, along x."""
    corner = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]) * side / 2

    def wall(u, v):
        return v * length, *(np.interp(4 * u, range(5), corner[:, i]) for i in (0, 1))

    nodes, walls = grid(wall, 4 * n, 5 * n, closed=True)
    sections = (ShellSection(thickness, **STEEL),) * len(walls)
    quads = [walls]
    for x in (0.0, length):
        plate, plate_quads = grid(lambda u, v, x=x: (x, (u - 0.5) * side, (v - 0.5) * side), n, n)
        distance = np.linalg.norm(nodes[None] - plate[:, None], axis=2)
        shared = distance.min(axis=1) < 1e-9
        number = np.where(shared, distance.argmin(axis=1), len(nodes) + np.cumsum(~shared) - 1)
        nodes = np.vstack([nodes, plate[~shared]])
        quads.append(number[plate_quads])
        sections += (ShellSection(0.05, **STEEL),) * len(plate_quads)
    return FiniteElementMesh(nodes, np.vstack(quads), sections)


def test_torsion_of_a_closed_tube_is_that_of_bredt():
    # J = 4 A² t / s, A the area inside the middle of the wall and s its length: side³ t here. The
    # walls' own torsion adds s t³ / 3; the end plates keep the ends from warping, which is stiffer.
    side, length, thickness = 0.1, 1.0, 0.002
    mesh = box_tube(side, length, thickness)
    front, rear = (station(mesh.nodes, np.array([x, side / 2, 0.0])) for x in (0.0, length))
    found = torsional_stiffness(assemble(mesh), front, rear)
    J = side**3 * thickness + 4 * side * thickness**3 / 3
    np.testing.assert_allclose(found, G * J / length, rtol=0.02)


def test_station_is_the_nearest_node_and_its_mirror_image():
    assert station(shaft_with_arms().nodes, np.array([1.4, 0.25, 0.1])) == (13, 14)


def test_stiffness_is_in_si_units():
    matrices = assemble(shaft_with_arms())
    in_degrees = torsional_stiffness(matrices, (11, 12), (13, 14)) / factor(
        "N m/deg", "rotational_stiffness"
    )
    np.testing.assert_allclose(in_degrees, np.radians(G * BAR.torsion_constant / 1.5), rtol=1e-5)


def test_station_without_width_is_refused():
    with pytest.raises(SolveError, match="nodes 0 and 0: found no width"):
        torsional_stiffness(assemble(bar()), (0, 0), (20, 20))


def test_torsion_of_one_station_against_itself_is_refused():
    with pytest.raises(SolveError, match="no deflection"):
        torsional_stiffness(assemble(shaft_with_arms()), (11, 12), (11, 12))


def test_supports_at_one_place_are_refused():
    with pytest.raises(SolveError, match=r"found both at x = 0\.0 m"):
        beaming_stiffness(assemble(bar()), (0, 0), (10, 10), (0, 0))
