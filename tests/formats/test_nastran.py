import re
from pathlib import Path

import numpy as np
import pytest
from free_network import CORNERS, HEXA, LABELS, free_network
from network_files import network_op2
from op2_files import COMPLEX_MODES, MODES, Op2

from modeviz.errors import VehicleError
from modeviz.formats.nastran import read_nastran

SHARED = Path(__file__).parents[3] / "shared/data/s1_msc_modes_bdf_op2_f06"
NAME = "mode_solid_shell_bar"
ELEMENTS = {"line": 4, "triangle": 8, "quad": 4, "tetra": 2, "wedge": 2, "hexa": 1}
SQUARE = [(1, 0, (0, 0, 0), 0), (2, 0, (1, 0, 0), 0), (3, 0, (1, 1, 0), 0), (4, 0, (0, 1, 0), 0)]


OP2 = Op2()
GEOMETRY = OP2.table("GEOM1", OP2.grids(SQUARE))


@pytest.fixture
def read(tmp_path):
    def read(op2=None, deck=None, **others):
        paths = []
        for name, content in {"a.op2": op2, "a.bdf": deck}.items():
            if content is not None:
                paths.append(tmp_path / name)
                raw = content if isinstance(content, bytes) else content.encode("latin-1")
                paths[-1].write_bytes(raw)
        for name, text in others.items():
            (tmp_path / name).write_text(text)
        return read_nastran(paths)

    return read


def printed_shapes() -> dict[int, dict[int, list[float]]]:
    """Every eigenvector that the F06 file prints: by mode, by grid."""
    shapes: dict[int, dict[int, list[float]]] = {}
    mode = 0
    for line in (SHARED / f"{NAME}.f06").read_text("latin-1").splitlines():
        if found := re.search(r"E I G E N V E C T O R   N O \.\s+(\d+)", line):
            mode = int(found[1])
        elif line.startswith("1 "):
            mode = 0
        elif mode and (row := re.match(r"\s+(\d+)\s+G\s+(.*)", line)):
            shapes.setdefault(mode, {})[int(row[1])] = [float(v) for v in row[2].split()]
    return shapes


@pytest.mark.shared
@pytest.mark.parametrize("endings", [(".bdf", ".op2"), (".op2",)])
def test_modes_of_msc_nastran_are_those_it_prints(endings):
    component = read_nastran([SHARED / (NAME + ending) for ending in endings])
    np.testing.assert_allclose(component.modes.frequency_hz, [71.26832, 75.95746, 125.7872], rtol=1e-6)
    printed = printed_shapes()
    assert {mode: len(grids) for mode, grids in printed.items()} == {1: 25, 2: 25, 3: 25}
    for mode, grids in printed.items():
        found = component.modes.shapes[component.rows(np.array(list(grids))), :, mode - 1]
        np.testing.assert_allclose(found, list(grids.values()), rtol=1e-6, atol=1e-9)
    (row,) = component.rows(np.array([13]))
    np.testing.assert_allclose(
        component.modes.shapes[row, :3, 0], [-0.36347, -1.34799, 0.00767], atol=5e-6
    )


@pytest.mark.shared
@pytest.mark.parametrize("endings", [(".bdf", ".op2"), (".op2",), (".bdf",)])
def test_geometry_of_msc_nastran_is_in_either_file_and_in_what_it_includes(endings):
    component = read_nastran([SHARED / (NAME + ending) for ending in endings])
    assert len(component.node_ids) == 25
    assert {kind: len(corners) for kind, corners in component.elements.items()} == ELEMENTS
    places = component.nodes[component.rows(np.array([13, 22, 4]))]
    np.testing.assert_array_equal(places, [[0.5, 0.5, 3], [0, 0, -3], [0, 1, 0]])


@pytest.mark.shared
def test_without_a_table_of_eigenvalues_the_input_says_the_modal_masses():
    alone = read_nastran([SHARED / f"{NAME}.op2"])
    assert np.isnan(alone.modes.modal_mass).all()
    both = read_nastran([SHARED / f"{NAME}.op2", SHARED / f"{NAME}.bdf"])
    np.testing.assert_array_equal(both.modes.modal_mass, 1)
    assert any("no table of eigenvalues" in note for note in both.notes)


@pytest.mark.shared
def test_a_frequency_response_has_geometry_and_no_modes():
    component = read_nastran([SHARED / "freq_solid_shell_bar.op2"])
    assert component.n_modes == 0
    assert "the file of results has no modes" in component.notes
    assert len(component.node_ids) == 25


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("size", [4, 8])
@pytest.mark.parametrize("most", [7, 10_000])
def test_words_of_either_order_and_size_in_parts_of_any_length(read, order, size, most):
    network = free_network()
    component = read(network_op2(Op2(order, size, most)))
    np.testing.assert_array_equal(component.node_ids, LABELS)
    np.testing.assert_allclose(component.nodes, CORNERS)
    np.testing.assert_allclose(component.modes.shapes[:, :3], network.shapes, rtol=1e-5, atol=1e-5)
    np.testing.assert_allclose(component.modes.frequency_hz, network.frequency_hz, rtol=1e-5, atol=1e-2)
    assert component.node_ids[component.elements["hexa"]].tolist() == [list(HEXA)]


def test_hertz_are_those_of_the_eigenvalue_whatever_stands_for_them(read):
    network = free_network()
    wrong = np.sqrt(np.abs(network.omega_n_squared))  # rad/s, as some versions write
    component = read(network_op2(Op2(), hertz=wrong))
    np.testing.assert_allclose(component.modes.frequency_hz[6:], network.frequency_hz[6:], rtol=1e-5)


def test_modal_masses_are_those_of_the_table_of_eigenvalues_and_zero_is_unknown(read):
    masses = np.geomspace(0.1, 10, 24)
    np.testing.assert_allclose(read(network_op2(Op2(), masses=masses)).modes.modal_mass, masses, 1e-6)
    op2 = Op2()
    zero = op2.table("LAMA", *op2.eigenvalues((1, 400.0, 0.0, 0.0)))
    shape = op2.table("OUGV1", op2.header(MODES, 1, 400.0), op2.shape([1, 2, 3, 4], np.ones((4, 6))))
    content = op2.file(op2.table("GEOM1", op2.grids(SQUARE)), zero, shape)
    assert np.isnan(read(content).modes.modal_mass).all()


def test_rows_of_eigenvalues_that_are_another_analysis_are_not_the_modes(read):
    op2 = Op2()
    buckling = op2.table("LAMA", *op2.eigenvalues((1, 1.7, 0.0, 5.0)))
    shape = op2.table("OUGV1", op2.header(MODES, 1, 400.0), op2.shape([1, 2, 3, 4], np.ones((4, 6))))
    content = op2.file(op2.table("GEOM1", op2.grids(SQUARE)), buckling, shape)
    assert np.isnan(read(content).modes.modal_mass).all()


@pytest.mark.parametrize("in_deck", [False, True])
def test_motions_are_turned_out_of_the_systems_of_their_grids(read, in_deck):
    """By hand: at (0, 2, 0) r is y and θ is -x; at (0, 0, 2) θ of the sphere is x, φ is y."""
    op2 = Op2()
    points = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 0]])
    turned = np.array([[5, 5, 5], [5, 5, 6], [5, 6, 5]])  # its x is y, its y is -x
    grids = [(1, 0, (0, 2, 0), 10), (2, 0, (0, 0, 2), 20), (3, 0, (7, 7, 7), 30), (4, 0, (1, 2, 3), 0)]
    frames = [op2.frame("C", 10, points), op2.frame("S", 20, points), op2.frame("R", 30, turned)]
    motion = np.tile([1.0, 2, 3, 4, 5, 6], (4, 1))
    shape = op2.table("OUGV1", op2.header(MODES, 1, 400.0), op2.shape([1, 2, 3, 4], motion))
    geometry = [] if in_deck else [op2.table("GEOM1", op2.grids(grids), *frames)]
    deck = (
        "CORD2C,10,0,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n"
        "CORD2S        20       0      0.      0.      0.      0.      0.      1.\n"
        "              1.      0.      0.\n"
        "CORD2R*               30               0              5.              5.\n"
        "*                     5.              5.              5.              6.\n"
        "*                     5.              6.              5.\n"
        "GRID,1,,0.,2.,0.,10\nGRID,2,,0.,0.,2.,20\nGRID,3,,7.,7.,7.,30\nGRID,4,,1.,2.,3.\n"
    )
    component = read(op2.file(*geometry, shape), deck if in_deck else None)
    expected = [[-2, 1, 3, -5, 4, 6], [2, 3, 1, 5, 6, 4], [-2, 1, 3, -5, 4, 6], [1, 2, 3, 4, 5, 6]]
    np.testing.assert_allclose(component.modes.shapes[:, :, 0], expected, atol=1e-6)


def test_motions_in_tables_of_the_basic_system_are_not_turned(read):
    op2 = Op2()
    grids = [(1, 0, (0, 2, 0), 10), *SQUARE[1:]]
    frame = op2.frame("C", 10, [[0, 0, 0], [0, 0, 1], [1, 0, 0]])
    motion = np.tile([1.0, 2, 3, 4, 5, 6], (4, 1))
    shape = op2.table("BOUGV1", op2.header(MODES, 1, 400.0), op2.shape([1, 2, 3, 4], motion))
    component = read(op2.file(op2.table("GEOM1", op2.grids(grids), frame), shape))
    np.testing.assert_allclose(component.modes.shapes[:, :, 0], motion)


def test_grids_in_double_precision(read):
    op2 = Op2(">")
    rows = [(7, 0, (0.1, -2.0, 3e5), 0), (8, 5, (1, 2, 3), 0)]
    frame = op2.frame_in_double_precision(5, [[0.1, 0, 0], [0.1, 0, 1], [1.1, 0, 0]])
    table = op2.table("GEOM1S", op2.grids_in_double_precision(rows), frame)
    np.testing.assert_allclose(read(op2.file(table)).nodes, [rows[0][2], [1.1, 2, 3]], rtol=1e-15)


def test_matrices_between_the_tables_are_gone_over(read):
    """In double precision, so that a key says how many numbers, and not words, a column has."""
    op2 = Op2()
    name = op2.words("KHH     ")
    matrix = op2.record(name) + op2.key(-1) + op2.record(op2.words(101, *[0] * 6)) + op2.key(-2)
    matrix += op2.record(op2.words(0)) + op2.record(name) + op2.key(-3)
    for number in (1, 2):
        column = op2.words(1) + np.array([1.5, 2.5], "<f8").tobytes()
        matrix += op2.record(op2.words(1)) + op2.key(3) + op2.fortran(column) + op2.key(-3 - number)
    matrix += op2.record(op2.words(0)) + op2.key(0)
    assert len(read(op2.file(matrix, GEOMETRY)).node_ids) == 4


def test_an_op2_file_without_geometry_is_listed(read):
    component = read(shaped(OP2.header(MODES, 1, 400.0)).replace(GEOMETRY, b""))
    assert component.n_modes == 1
    assert not component.has_place.any()
    assert component.notes == ("the file of results has no geometry: give the input file too",)


def test_an_unstable_mode_has_a_frequency_below_zero(read):
    component = read(shaped(OP2.header(MODES, 1, -400.0)))
    assert component.modes.frequency_hz == pytest.approx([-20 / (2 * np.pi)])


def test_scalar_points_are_left_out_and_told(read):
    op2 = Op2()
    shape = op2.shape([1, 2, 3, 4, 900], np.ones((5, 6)), [1, 1, 1, 1, 2])
    table = op2.table("OUGV1", op2.header(MODES, 1, 400.0), shape)
    component = read(op2.file(op2.table("GEOM1", op2.grids(SQUARE)), table))
    assert component.node_ids.tolist() == [1, 2, 3, 4]
    assert any("1 scalar points" in note for note in component.notes)


def test_other_subcases_are_left_out_and_told(read):
    op2 = Op2()
    shape = op2.shape([1, 2, 3, 4], np.ones((4, 6)))
    records = [part for n in (1, 2) for part in (op2.header(MODES, 1, 100.0 * n, subcase=n), shape)]
    component = read(op2.file(op2.table("GEOM1", op2.grids(SQUARE)), op2.table("OUGV1", *records)))
    assert component.n_modes == 1
    assert any("1 modes of other subcases than 1" in note for note in component.notes)


def test_modes_of_further_rotor_speeds_are_left_out_and_told(read):
    """They have the numbers of the first ones again, and other eigenvalues."""
    op2 = Op2()
    shape = op2.shape([1, 2, 3, 4], np.ones((4, 6)))
    headers = [
        op2.header(MODES, mode, value) for value, mode in ((9.0, 1), (16.0, 2), (25.0, 1), (36.0, 2))
    ]
    records = [part for header in headers for part in (header, shape)]
    component = read(op2.file(op2.table("GEOM1", op2.grids(SQUARE)), op2.table("OUGV1", *records)))
    np.testing.assert_allclose(component.modes.frequency_hz, np.array([3, 4]) / (2 * np.pi))
    assert any(note.startswith("2 modes have the number of one before") for note in component.notes)


def sorted_by_grid(op2: Op2, grids, motions, eigenvalues=(100.0, 400.0), kind=1) -> bytes:
    """A table of modes in SORT2: motions (n_grids, n_modes, 6)."""
    records = []
    for grid, rows in zip(grids, motions, strict=True):
        records.append(op2.header(MODES, 10 * grid + 2, 0.0, sort=2))
        records.append(b"".join(op2.words(i, kind, *map(float, row)) for i, row in enumerate(rows, 1)))
    return op2.table("OUGV2", *records)


@pytest.mark.parametrize("op2", [Op2(), Op2(">", 8)])
def test_modes_sorted_by_grid_are_those_sorted_by_mode(read, op2):
    motions = np.arange(48.0).reshape(4, 2, 6)
    geometry = op2.table("GEOM1", op2.grids(SQUARE))
    lama = op2.table("LAMA", *op2.eigenvalues((1, 100.0, 0.0, 2.0), (2, 400.0, 0.0, 3.0)))
    scalar = sorted_by_grid(op2, [9], motions[:1], kind=2)
    component = read(op2.file(geometry, lama, sorted_by_grid(op2, [1, 2, 3, 4], motions), scalar))
    np.testing.assert_allclose(component.modes.shapes, motions.transpose(0, 2, 1))
    np.testing.assert_allclose(component.modes.frequency_hz, np.array([10, 20]) / (2 * np.pi))
    np.testing.assert_allclose(component.modes.modal_mass, [2, 3])


def test_modes_sorted_by_grid_without_their_eigenvalues_are_refused(read):
    op2 = Op2()
    with pytest.raises(VehicleError, match="its eigenvalue is in no table"):
        read(op2.file(sorted_by_grid(op2, [1], np.ones((1, 2, 6)))))


def test_superelements_that_have_a_table_each_are_one_component(read):
    """Grid 2 is in both, as on their boundary."""
    op2 = Op2()
    tables = []
    for grids, motion in (([1, 2], 1.0), ([2, 3, 4], 3.0)):
        own = [grid for grid in SQUARE if grid[0] in grids]
        tables.append(op2.table("GEOM1S", op2.grids(own)))
        tables.append(op2.table("GEOM2S", op2.words(3001, 30, 48, grids[0], 1, *grids[:2])))
        shape = op2.shape(grids, np.full((len(grids), 6), motion))
        tables.append(op2.table("OUGV1", op2.header(MODES, 1, 400.0), shape))
    component = read(op2.file(*tables))
    assert component.n_modes == 1
    assert component.modes.shapes[:, 0, 0].tolist() == [1, 1, 3, 3]
    assert component.elements["line"].tolist() == [[0, 1], [1, 2]]
    assert component.notes == ()


def test_elements_that_are_there_twice_are_drawn_once(read):
    op2 = Op2()
    rod = op2.table("GEOM2", op2.words(3001, 30, 48, 7, 1, 1, 2))
    component = read(op2.file(op2.table("GEOM1", op2.grids(SQUARE)), rod, rod))
    assert component.elements["line"].tolist() == [[0, 1]]


@pytest.mark.parametrize(
    ("key", "kind", "before", "width"),
    [
        ((7708, 77, 9960), "hexa", 3, 23),  # CHEXAL, of layers
        ((7108, 71, 9961), "wedge", 3, 18),
        ((14000, 140, 9990), "hexa", 2, 22),  # CHEXAFD, of hyperelastic material
        ((16100, 161, 9986), "tetra", 2, 12),
        ((16200, 162, 9987), "triangle", 2, 8),
        ((13900, 139, 9989), "quad", 2, 11),
        ((5701, 57, 981), "quad", 2, 16),  # CPLSTN4, of plane strain
        ((15418, 154, 0), "line", 2, 27),  # CBEAM3
    ],
)
def test_variants_of_elements_are_drawn(read, key, kind, before, width):
    op2 = Op2()
    grids = [(i, 0, place, 0) for i, place in enumerate(CORNERS, 1)]
    corners = list(range(1, {"line": 3, "triangle": 4, "quad": 5, "tetra": 5, "wedge": 7}.get(kind, 9)))
    elements = [[n, 1, 0][:before] + corners for n in (1, 2)]
    words = [word for element in elements for word in element + [0] * (width - len(element))]
    geometry = op2.table("GEOM1", op2.grids(grids))
    component = read(op2.file(geometry, op2.table("GEOM2", op2.words(*key, *words))))
    assert (component.elements[kind] + 1).tolist() == [corners, corners]


def test_complex_modes_have_damping_and_no_modal_mass(read):
    op2 = Op2()
    header = op2.header(COMPLEX_MODES, 1, complex(-3.0, 100.0), width=14)
    motion = np.hstack([np.ones((4, 6)), 2 * np.ones((4, 6))])
    table = op2.table("OUGV1", header, op2.shape([1, 2, 3, 4], motion))
    modes = read(op2.file(op2.table("GEOM1", op2.grids(SQUARE)), table)).modes
    size = abs(complex(-3, 100))
    np.testing.assert_allclose(modes.frequency_hz, size / (2 * np.pi))
    np.testing.assert_allclose(modes.damping_ratio, 3 / size)
    np.testing.assert_array_equal(modes.shapes, 1 + 2j)


def test_fields_of_every_form_and_numbers_without_an_e(read):
    deck = (
        "SOL 103\nCEND\nMETHOD=1\nBEGIN BULK\n"
        "$ GRID,99,,1.,1.,1.\n"
        "GRID           1             1.5    -2.+  3.-1$ small\n"
        "GRID*                  2                        1.5D+1           2.5E1\n"
        "*                    -.5               0\n"
        "grid,3,0,1.+1,,7\n"
        "GRID\t4\t\t1.\t2.\t3.\n"
        "GRID*,5,,1.,2.\n*,3.,\n"
        "CORD2C,1,0, 0.,0.,0., 0.,0.,1., 0.,1.,0.\nGRID,6,1,2.,0.,1.\n"
        "ENDDATA\nGRID,100,,0.,0.,0.\n"
    ).replace("    -2.+  3.-1", "   -2.+1    3.-1")
    component = read(deck=deck)
    assert component.node_ids.tolist() == [1, 2, 3, 4, 5, 6]
    expected = [[1.5, -20, 0.3], [15, 25, -0.5], [10, 0, 7], [1, 2, 3], [1, 2, 3], [0, 2, 1]]
    np.testing.assert_allclose(component.nodes, expected, atol=1e-12)


def test_what_grdset_says_holds_where_a_grid_says_nothing(read):
    frame = "CORD2R,5,,10.,0.,0.,10.,0.,1.\n,11.,0.,0.\n"
    deck = f"GRDSET,,5,,,,5\n{frame}GRID,1,,1.,0.,0.\nGRID,2,0,1.,0.,0.,0\n"
    np.testing.assert_allclose(read(deck=deck).nodes, [[11, 0, 0], [1, 0, 0]])


def test_places_in_a_sphere_are_by_the_angle_from_its_axis_and_that_about_it(read):
    deck = "CORD2S,1,,1.,0.,0.,1.,0.,1.\n,2.,0.,0.\nGRID,1,1,2.,90.,30.\nGRID,2,1,2.,30.,90.\n"
    expected = [[1 + 3**0.5, 1, 0], [1, 1, 3**0.5]]
    np.testing.assert_allclose(read(deck=deck).nodes, expected, atol=1e-12)


def test_systems_given_by_grids_that_stand_in_other_systems(read):
    """x along y of the outer system, which is turned by 90° about z: along -x of the basic one."""
    deck = (
        "CORD2R,1,,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\n"
        "GRID,1,1,0.,0.,0.\nGRID,2,1,0.,0.,1.\nGRID,3,1,0.,1.,0.\n"
        "CORD1R,2,1,2,3\nGRID,4,2,1.,0.,0.\n"
    )
    np.testing.assert_allclose(read(deck=deck).nodes[3], [-1, 0, 0], atol=1e-12)


def test_files_that_are_included_are_found_beside_those_that_include_them(tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "a.bdf").write_text("BEGIN BULK\ninclude 'parts/\n  b.bdf'\nENDDATA\n")
    (tmp_path / "parts" / "b.bdf").write_text('GRID,1,,1.,1.,1.\nINCLUDE "..\\c.bdf"\n')
    (tmp_path / "c.bdf").write_text("GRID,2,,2.,2.,2.\n")
    assert read_nastran([tmp_path / "a.bdf"]).node_ids.tolist() == [1, 2]


def test_a_file_included_before_the_bulk_data_may_be_missing(read):
    """As one with changes to the solution sequence, which stays where the solver is."""
    deck = "SOL 103\nINCLUDE '/dmap/changes.v9'\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nENDDATA\n"
    component = read(deck=deck + "INCLUDE 'after the end'\n")
    assert component.node_ids.tolist() == [1]
    assert any("changes.v9': there is no such file; it is before" in note for note in component.notes)


def test_files_that_are_included_may_stand_beside_the_first(tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "a.bdf").write_text("INCLUDE 'parts/b.bdf'\n")
    (tmp_path / "parts" / "b.bdf").write_text("INCLUDE 'parts/c.bdf'\n")
    (tmp_path / "parts" / "c.bdf").write_text("GRID,2,,2.,2.,2.\n")
    assert read_nastran([tmp_path / "a.bdf"]).node_ids.tolist() == [2]


@pytest.mark.parametrize(
    "deck",
    [
        "CEND\nBEGIN BULK\nBEGIN BULK\nGRID,1,,0.,0.,0.\nBEGIN SUPER=5\nGRID,1,,9.,9.,9.\n",
        "CEND\nBEGIN SUPER=5\nGRID,1,,9.,9.,9.\nBEGIN BULK\nGRID,1,,0.,0.,0.\nENDDATA\n",
        "CEND\nBEGIN BULK SUPER = 5\nGRID,2\nBEGIN BULK\nGRID,1,,0.,0.,0.\nBEGIN AUXMODEL=2\n",
    ],
)
def test_superelements_of_the_input_are_left_out_and_told(read, deck):
    component = read(deck=deck)
    assert component.nodes.tolist() == [[0, 0, 0]]
    assert any("superelements that the input file has" in note for note in component.notes)


def test_cards_that_say_how_they_differ_from_the_one_before(read):
    """By the guide's example: = is the field before, *(x) that and x more, =n how often."""
    deck = (
        "GRID,101,17,1.0,10.5,,17,3456\n=,*1,=,*.2,==\n=3\n"
        "CORD2R,17,,0.,0.,0.,0.,0.,1.,+C\n+C,1.,0.,0.\n"
        "GRID    201             0.      5.      0.\n=       *(10)   =       *(2.5)  ==\n"
        "FORCE,1,101,,1.\n=,=,*1,==\nCBAR,1,1,101,102,0.,0.,1.\n=,*(1),=,*(1),*(1),==\n=(2)\n"
    )
    component = read(deck=deck)
    assert component.node_ids.tolist() == [*range(101, 106), 201, 211]
    np.testing.assert_allclose(component.nodes[:5, 0], [1.0, 1.2, 1.4, 1.6, 1.8])
    np.testing.assert_allclose(component.nodes[5:], [[0, 5, 0], [2.5, 5, 0]])
    assert component.elements["line"].tolist() == [[0, 1], [1, 2], [2, 3], [3, 4]]


def test_free_fields_with_marks_of_continuations_and_with_blanks_after_a_name(read):
    deck = "CORD2R, 5, , 0., 0., 0., 0., 0., 1., +C1,\n+C1, 0., 1., 1.\nGRID   1,5,1.,0.,0.\n"
    np.testing.assert_allclose(read(deck=deck).nodes, [[0, 1, 0]], atol=1e-12)


def test_corners_of_elements(read):
    grids = "".join(f"GRID,{i},,{i}.,0.,0.\n" for i in range(1, 31))
    deck = grids + (
        "CHEXA,1,1,1,2,3,4,5,6,+A\n+A,7,8,9,10,11,12,13,14,+B\n+B,15,16,17,18,19,20\n"
        "CPENTA,2,1,1,2,3,4,5,6\nCTETRA,3,1,1,2,3,4,5,6\n,7,8,9,10\nCPYRAM,4,1,1,2,3,4,5\n"
        "CQUAD8,5,1,1,2,3,4,5,6\n,7,8\nCTRIA6,6,1,1,2,3,4,5,6\n"
        "CBAR,7,1,1,2,0.,0.,1.\nCONROD,8,3,4,1,1.\nPLOTEL,9,5,6,,10,7,8\nCBUSH,10,1,7\nCELAS2,11,1.,1,1\n"
    )
    component = read(deck=deck)
    found = {k: component.node_ids[c].tolist() for k, c in component.elements.items()}
    assert found == {
        "hexa": [[1, 2, 3, 4, 5, 6, 7, 8]],
        "wedge": [[1, 2, 3, 4, 5, 6]],
        "tetra": [[1, 2, 3, 4]],
        "pyramid": [[1, 2, 3, 4, 5]],
        "quad": [[1, 2, 3, 4]],
        "triangle": [[1, 2, 3]],
        "line": [[1, 2], [3, 4], [5, 6], [7, 8]],
    }


@pytest.mark.parametrize(
    ("norm", "is_known"),
    [("EIGRL,1,,,10", True), ("EIGRL,1,,,10,,,,MAX", False), ("EIGR,1,LAN,,,,10\n,MASS", True),
     ("EIGR,1,LAN,,,,10\n,MAX", False), ("$", False)],
)  # fmt: skip
def test_only_modes_normalised_to_mass_have_a_modal_mass_without_a_table(read, norm, is_known):
    op2 = Op2()
    table = op2.table("OUGV1", op2.header(MODES, 1, 400.0), op2.shape([1, 2], np.ones((2, 6))))
    component = read(op2.file(table), f"GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n{norm}\n")
    assert np.isfinite(component.modes.modal_mass).all() == is_known


def test_a_factor_of_masses_is_told(read):
    (note, _) = read(deck="PARAM,WTMASS,.00259\nGRID,1,,0.,0.,0.\n").notes
    assert note.startswith("PARAM,WTMASS is 0.00259")


@pytest.mark.parametrize("op2", [Op2(), Op2(">", 8)])
def test_a_factor_of_masses_of_an_op2_file_is_told_once(read, op2):
    parameters = op2.words("POST    ", 1, -1, "AUTOSPC ", 3, "YES     ", "WTMASS  ", 2, 0.00259)
    content = op2.file(op2.table("PVT0", parameters), op2.table("GEOM1", op2.grids(SQUARE)))
    assert any(note.startswith("PARAM,WTMASS is 0.00259") for note in read(content).notes)
    deck = "PARAM,WTMASS,.00259\n" + "".join(f"GRID,{i},,{i}.,0.,0.\n" for i in (1, 2))
    assert sum("WTMASS" in note for note in read(content, deck).notes) == 1


def test_a_factor_of_masses_in_double_precision(read):
    op2 = Op2()
    double = np.array([0.031081], "<f8").tobytes()
    content = op2.file(
        op2.table("PVT0", op2.words("WTMASS  ", 4) + double), op2.table("GEOM1", op2.grids(SQUARE))
    )
    assert any(note.startswith("PARAM,WTMASS is 0.031081") for note in read(content).notes)


def test_a_file_of_a_version_unknown_is_read_with_a_notice(read):
    op2 = Op2()
    tables = [op2.table("GEOM1", op2.grids(SQUARE))]
    for label in ("XXXXXXXX", "NX2412  ", "OS2022.2", "V2005R3B", "202110  "):
        assert not any("labelled" in note for note in read(op2.file(*tables, label=label)).notes)
    component = read(op2.file(*tables, label="NEW2031 "))
    assert len(component.node_ids) == 4
    assert any("labelled 'NEW2031', as by no version known" in note for note in component.notes)


@pytest.mark.parametrize("by", ["GPL", "EQEXIN"])
def test_grids_without_geom1_are_in_the_tables_of_the_solvers_order(read, by):
    """As PARAM,POST,-4 writes them: grid 30 in a cylinder, and a scalar point among the grids."""
    op2 = Op2()
    numbers = [10, 30, 20]
    ids = op2.words(*numbers) if by == "GPL" else op2.words(10, 1, 20, 3, 30, 2)
    points = op2.words(1, 0, 1.0, 2.0, 3.0, 0, 0) + op2.words(2, 7, 2.0, 90.0, 5.0, 7, 0)
    points += op2.words(3, -1, 0.0, 0.0, 0.0, 0, 0)
    frame = op2.words(7, 2, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0)  # x is y
    motion = op2.shape([10, 30], [[1.0, 0, 0, 0, 0, 0], [0.0, 1, 0, 0, 0, 0]])
    rod = op2.table("GEOM2", op2.words(3001, 30, 48, 7, 1, 10, 30))
    component = read(
        op2.file(
            op2.table(by, ids),
            op2.table("GPDT", points),
            op2.table("CSTM", frame),
            rod,
            op2.table("OPHIG", op2.header(MODES, 1, 400.0), motion),
        )
    )
    assert component.node_ids.tolist() == [10, 30]
    np.testing.assert_allclose(component.nodes, [[1, 2, 3], [6, 0, 2]], atol=1e-6)
    np.testing.assert_allclose(component.modes.shapes[1, :3, 0], [0, -1, 0], atol=1e-6)
    assert component.elements["line"].tolist() == [[0, 1]]


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ([("GPL", OP2.words(1, 2)), ("GPDT", OP2.words(*[0] * 13))], "13 words, expected 7 for each"),
        ([("GPL", OP2.words(1)), ("GPDT", OP2.words(*[9] * 7))], "beyond those that have a number"),
        ([("EQEXIN", OP2.words(1, 5)), ("GPDT", OP2.words(*[1] * 7))], "does not say one place"),
        (
            [
                ("GPL", OP2.words(1)),
                ("GPDT", OP2.words(1, *[0] * 6)),
                ("CSTM", OP2.words(1, 9, *[0] * 12)),
            ],
            "of kind 9 in CSTM",
        ),
    ],
)
def test_damaged_tables_of_points_are_refused(read, tables, words):
    with pytest.raises(VehicleError, match=words):
        read(OP2.file(*(OP2.table(*table) for table in tables)))


def test_names_may_have_eight_letters_in_words_of_eight_bytes(read):
    op2 = Op2(size=8)
    content = op2.file(op2.table("GEOM1", op2.grids(SQUARE)))
    usual, other = op2.words("GEOM1   "), b"GEOM1   " + b" " * 8
    assert len(read(content.replace(usual, other)).node_ids) == 4


def placed(*records: bytes) -> bytes:
    """A file with these records of geometry."""
    return OP2.file(OP2.table("GEOM1", *records))


def shaped(header: bytes, motion: float = 1.0, ids=(1, 2, 3, 4)) -> bytes:
    """A file with one mode."""
    shape = OP2.shape(ids, np.full((4, 6), motion))
    return OP2.file(GEOMETRY, OP2.table("OUGV1", header, shape))


WHOLE = shaped(OP2.header(MODES, 1, 400.0))


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "the file is empty"),
        (b"hello, this is no OP2 file at all", "does not begin as an OP2 file"),
        (WHOLE[:-20], "cut"),
        (WHOLE[:-27], "cut"),
        (WHOLE[: len(WHOLE) // 4], "the file ends within the table 'GEOM1'"),
        (WHOLE[: len(WHOLE) // 2], "the file ends within the table 'OUGV1'"),
        (WHOLE[:300] + b"\r" + WHOLE[300:], "the file is damaged"),
        (WHOLE.replace(OP2.words(4501, 45, 1), OP2.words(4501, 45, 1)[:8]), "damaged"),
        (shaped(OP2.header(MODES, 1, np.nan)), "no finite number"),
        (
            shaped(OP2.header(MODES, 1, 4.0), np.nan),
            "mode 1: its motions have values",
        ),
        (shaped(OP2.header(MODES, 1, 4.0, width=2_000_000_000)), "2000000000"),
        (shaped(OP2.header(COMPLEX_MODES, 1, 4.0, width=14, sort=2)), "expected a multiple of 14"),
        (OP2.file(), "has neither geometry nor modes"),
        (placed(OP2.grids([*SQUARE, (1, 0, (9, 9, 9), 0)])), "GRID 1: is there twice"),
        (placed(OP2.grids([(1, 0, (np.inf, 0, 0), 0)])), "not finite"),
        (placed(OP2.grids([(1, 77, (0, 0, 0), 0)])), "coordinate systems 77"),
        (placed(OP2.grids(SQUARE)[:-8]), "expected a multiple of 8"),
        (placed(OP2.grids(SQUARE), OP2.frame("R", 5, np.zeros((3, 3)))), "system 5: the three points"),
        (placed(OP2.grids(SQUARE), OP2.frame("R", 5, np.eye(3), 5)), "coordinate systems 5"),
        (shaped(OP2.header(MODES, 1, 4.0), ids=[1, 2, 2, 4]), "moves grid 2 twice"),
    ],
)
def test_damaged_op2_files_are_refused_in_a_sentence(read, content, words):
    with pytest.raises(VehicleError) as caught:
        read(content)
    assert words in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize(
    ("deck", "words"),
    [
        ("", "found no GRID"),
        ("GRID,1,,0.,0.,0.\nGRID,1,,0.,0.,1.\n", "GRID 1: is there twice"),
        ("GRID,x,,0.,0.,0.\n", "GRID x: found 'x', expected a whole number"),
        ("GRID,1,,0.,y,0.\n", "GRID 1: found 'y', expected a number"),
        ("GRID,1,,nan,0.,0.\n", "the coordinates of grids have values that are not finite"),
        ("GRID,1,9,0.,0.,0.\n", "coordinate systems 9: are named but not there"),
        ("GRID,1,,0.,0.,0.\nCORD2R,2,3,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n", "coordinate systems 2"),
        ("GRID,1,,0.,0.,0.\nCORD1R,2,1,7,8\n", "one is missing"),
        ("GRID,1,,0.,0.,0.\nPLOTEL,1,1,5\n", "node 5 is named"),
        ("INCLUDE 'nowhere.bdf'\n", "'nowhere.bdf': there is no such file"),
        ("INCLUDE 'a.bdf'\n", "includes itself, so it would never end"),
        ("INCLUDE 'a.bdf\n", "its quote does not end"),
        ("INCLUDE '/dev/zero'\n", "cannot be read"),
        ("GRID,1\0\0\n", "found no text"),
        ("GRID,99999999999999999999,,0.,0.,0.\n", "expected a whole number"),  # found at random
        ("GRID,1,,0.,0.,0.\n=,*x,==\n", "found '1' to be increased by 'x'"),
        ("GRID,1,,0.,0.,0.\n=,*1,==\n=(900000000)\n", "is repeated 900,000,000 times"),
    ],
)
def test_damaged_decks_are_refused_in_a_sentence(read, deck, words):
    with pytest.raises(VehicleError) as caught:
        read(deck=deck)
    assert words in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_each_file_of_a_loop_of_includes_is_named_once(tmp_path):
    """With what is wrong with a file that is included, too."""
    for name, included in (("a.bdf", "b.inc"), ("b.inc", "c.inc"), ("c.inc", "a.bdf")):
        (tmp_path / name).write_text(f"INCLUDE '{included}'\n")
    with pytest.raises(VehicleError, match="again one of these files") as caught:
        read_nastran([tmp_path / "a.bdf"])
    assert [str(caught.value).count(name) for name in ("a.bdf", "b.inc", "c.inc")] == [1, 1, 1]
    (tmp_path / "c.inc").write_bytes(b"\0")
    with pytest.raises(VehicleError, match="found no text") as caught:
        read_nastran([tmp_path / "a.bdf"])
    assert [str(caught.value).count(name) for name in ("a.bdf", "b.inc", "c.inc")] == [1, 1, 1]


def test_files_that_include_others_are_followed_so_far_only(tmp_path):
    for level in range(30):
        (tmp_path / f"{level}.bdf").write_text(f"INCLUDE '{level + 1}.bdf'\n")
    with pytest.raises(VehicleError, match="include others, 20 deep"):
        read_nastran([tmp_path / "0.bdf"])
    (tmp_path / "empty.inc").write_text("")
    (tmp_path / "many.bdf").write_text("INCLUDE 'empty.inc'\n" * 1000)
    with pytest.raises(VehicleError, match="includes 1000 files or more"):
        read_nastran([tmp_path / "many.bdf"])


def test_an_input_file_of_another_model_is_refused(read):
    """It shares a few numbers of grids with the run, as nearly all models do."""
    grids = [(number, 0, (float(number), 0.0, 0.0), 0) for number in range(1, 6)]
    shape = OP2.shape(range(1, 6), np.ones((5, 6)))
    moved = OP2.table("OUGV1", OP2.header(MODES, 1, 100.0), shape)
    op2 = OP2.file(OP2.table("GEOM1", OP2.grids(grids)), moved)
    shared = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n"
    with pytest.raises(VehicleError, match=r"not of one model: 3 of the 5 grids that a\.op2 moves"):
        read(op2, f"BEGIN BULK\n{shared}ENDDATA\n")
    component = read(op2, f"BEGIN BULK\n{shared}GRID,3,,2.,0.,0.\nENDDATA\n")
    assert "2 grids are moved but not in the input file" in component.notes


def test_two_decks_are_refused(tmp_path):
    for name in ("a.bdf", "b.dat"):
        (tmp_path / name).write_text("GRID,1,,0.,0.,0.\n")
    with pytest.raises(VehicleError, match=r"a\.bdf, b\.dat, expected one input file"):
        read_nastran([tmp_path / "a.bdf", tmp_path / "b.dat"])


@pytest.mark.parametrize("line", ["1,2,3", "    -1", "        12.5", "*"])
def test_text_that_is_no_input_is_refused_before_it_is_read_to_its_end(tmp_path, line):
    path = tmp_path / "mislabelled.bdf"
    path.write_text(f"{line}\n" * 2000, encoding="utf-8")
    with pytest.raises(VehicleError, match="no card in the first"):
        read_nastran([path])
