from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import pyuff
from universal_files import (
    block,
    elements_2412,
    frame_18,
    frame_2420,
    nodes_15,
    nodes_2411,
    shape_55,
    shape_2414,
    units_164,
)

from modeviz.errors import VehicleError
from modeviz.formats.universal import read_universal

SHARED = Path(__file__).parents[3] / "shared/data/s2_uff_test_models"
SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


@pytest.fixture
def read(tmp_path):
    def read(*texts, encoding="latin-1"):
        paths = []
        for number, text in enumerate(texts):
            paths.append(tmp_path / f"{number}.unv")
            paths[-1].write_bytes(text if isinstance(text, bytes) else text.encode(encoding))
        return read_universal(paths)

    return read


@pytest.mark.shared
@pytest.mark.parametrize(
    ("name", "n_nodes", "elements"),
    [
        ("testlab_geometry_15_82_18.uff", 36, {"line"}),
        ("artemis_geometry_15_82_2412.uff", 74, {"line", "triangle"}),
        ("mesh_Oros-modal_uff15_uff2412.uff", 96, {"quad"}),
    ],
)
def test_geometry_of_test_systems(name, n_nodes, elements):
    component = read_universal([SHARED / name])
    assert len(component.node_ids) == n_nodes
    assert set(component.elements) == elements
    assert component.n_modes == 0


@pytest.mark.shared
def test_elements_of_test_systems_are_as_many_as_their_source_tells():
    assert len(read_universal([SHARED / "artemis_geometry_15_82_2412.uff"]).elements["triangle"]) == 108
    assert len(read_universal([SHARED / "mesh_Oros-modal_uff15_uff2412.uff"]).elements["quad"]) == 72


@pytest.mark.shared
@pytest.mark.parametrize(
    ("name", "lengths"),
    [("testlab_geometry_15_82_18.uff", [16, 32, 16]), ("artemis_geometry_15_82_2412.uff", [249, 75])],
)
def test_trace_lines_of_test_systems_are_those_that_pyuff_reads(name, lengths):
    lines = [one for one in pyuff.UFF(str(SHARED / name)).read_sets() if one["type"] == 82]
    assert [len(one["nodes"]) for one in lines] == lengths  # with zeros that fill the last line
    pairs = [pair for one in lines for pair in pairwise(map(int, one["nodes"]))]
    expected = [pair for pair in pairs if 0 not in pair]
    component = read_universal([SHARED / name])
    assert component.node_ids[component.elements["line"]].tolist() == [list(pair) for pair in expected]


@pytest.mark.shared
def test_places_of_a_test_system_stand_in_the_systems_of_its_components():
    """By hand: system 1 has its origin at -2.4, -.95, 0, its x axis along -x and its z along -z."""
    path = SHARED / "testlab_geometry_15_82_18.uff"
    component = read_universal([path])
    raw = {}
    for one in pyuff.UFF(str(path)).read_sets():
        if one["type"] == 15:
            for i, label in enumerate(one["node_nums"]):
                raw[int(label)] = int(one["def_cs"][i]), np.array([one[axis][i] for axis in "xyz"])
    of_first = [label for label, (system, _) in raw.items() if system == 1]
    for label in of_first:
        x, y, z = raw[label][1]
        place = component.nodes[component.rows(np.array([label]))[0]]
        np.testing.assert_allclose(place, [-2.4 - x, -0.95 + y, -z], atol=1e-5)


@pytest.mark.shared
def test_shapes_of_test_systems_have_the_frequencies_their_source_tells():
    modes = read_universal([SHARED / "uff55_translation.uff"]).modes
    np.testing.assert_array_equal(modes.frequency_hz, [10, 12, 13])
    assert np.isnan(modes.modal_mass).all()
    assert modes.shapes.shape == (4, 6, 3)
    np.testing.assert_allclose(modes.shapes[0, :3, 0], -1.46518)
    turning = read_universal([SHARED / "uff55_translation_rotation.uff"]).modes
    np.testing.assert_array_equal(turning.frequency_hz, [97.013])
    assert turning.shapes.shape == (43, 6, 1)


@pytest.mark.shared
def test_a_complex_mode_of_a_test_system_has_numbers_that_touch():
    component = read_universal([SHARED / "uff55 sample_test record10.uff"])
    assert component.is_complex
    assert component.node_ids.tolist() == [60101, 111111]
    expected = [0, 0.1111111 + 0.09111111j, 0.007111111 + 0.004111111j]
    np.testing.assert_allclose(component.modes.shapes[1, :3, 0], expected)
    s = -0.1111111 + 41.11111j
    np.testing.assert_allclose(component.modes.frequency_hz, abs(s) / (2 * np.pi))
    np.testing.assert_allclose(component.modes.damping_ratio, 0.1111111 / abs(s))


@pytest.mark.parametrize("write", [shape_55, shape_2414])
def test_a_normal_mode_has_its_mass_and_damping(read, write):
    shape = np.arange(12.0).reshape(4, 3) - 5
    text = nodes_2411([1, 2, 3, 4], SQUARE) + write([1, 2, 3, 4], shape, 12.5, 3.5, 0.02)
    modes = read(text).modes
    assert modes.frequency_hz.tolist() == [12.5]
    assert modes.modal_mass.tolist() == [3.5]
    assert modes.damping_ratio.tolist() == [0.02]
    np.testing.assert_allclose(modes.shapes[:, :3, 0], shape)
    assert not modes.shapes[:, 3:].any()


@pytest.mark.parametrize("write", [shape_55, shape_2414])
def test_a_modal_mass_of_zero_is_unknown(read, write):
    assert np.isnan(read(write([1], np.ones((1, 3)), 10.0, 0.0)).modes.modal_mass).all()


def test_a_modal_mass_of_accelerations_is_unknown(read):
    text = shape_55([1], np.ones((1, 3)), 10.0, 1.0, result=12)
    assert np.isnan(read(text).modes.modal_mass).all()


def test_complex_shapes_in_single_and_double_precision(read):
    shape = np.array([[1 + 2j, -3j, 0.5, 0, 1e-3j, 4]])
    s = complex(-2.0, 100.0)
    old = shape_55([7], shape, [s.real, s.imag, 0, 0, 0, 0], analysis=3)
    for text in (old, shape_2414([7], shape, 0.0, eigenvalue=s)):
        modes = read(text).modes
        np.testing.assert_allclose(modes.shapes[0, :, 0], shape[0])
        np.testing.assert_allclose(modes.frequency_hz, abs(s) / (2 * np.pi), rtol=1e-5)
        np.testing.assert_allclose(modes.damping_ratio, 2 / abs(s), rtol=1e-5)
        assert np.isnan(modes.modal_mass).all()


def test_modes_come_in_the_order_of_their_frequencies(read):
    text = "".join(
        shape_55([1], np.full((1, 3), f), f, mode=i) for i, f in enumerate([30.0, 10.0, 20.0])
    )
    modes = read(text).modes
    np.testing.assert_array_equal(modes.frequency_hz, [10, 20, 30])
    np.testing.assert_array_equal(modes.shapes[0, 0], [10, 20, 30])


def test_a_node_that_a_mode_leaves_out_does_not_move_in_it(read):
    text = nodes_15([1, 2], SQUARE[:2]) + shape_55([2], np.ones((1, 3)), 10.0)
    np.testing.assert_array_equal(read(text).modes.shapes[:, 0, 0], [0, 1])


def test_geometry_and_shapes_may_be_in_two_files(read):
    component = read(nodes_15([5, 6], SQUARE[:2]), shape_55([6, 5], np.ones((2, 3)), 10.0))
    assert component.has_place.all()
    assert component.n_modes == 1


def test_moved_nodes_without_a_place_are_told(read):
    (note,) = read(shape_55([1], np.ones((1, 3)), 10.0)).notes
    assert "1 nodes are moved but stand nowhere" in note


def test_a_system_that_is_given_in_another_one_is_turned_twice(read):
    """Both turn x to y: the inner one's x is then along -x."""
    outer = frame_18(1, 0, 0, [1, 0, 0], [1, 1, 0], [1, 0, 1])
    inner = frame_18(2, 0, 1, [0, 2, 0], [0, 3, 0], [0, 2, 1])
    text = outer + inner + nodes_15([1], [[1.0, 0, 0]], 2, 2)
    component = read(text + shape_55([1], np.array([[1.0, 0, 0]]), 5.0))
    np.testing.assert_allclose(component.nodes, [[-2, 0, 0]], atol=1e-12)
    np.testing.assert_allclose(component.modes.shapes[0, :3, 0], [-1, 0, 0], atol=1e-12)


def test_a_system_that_is_given_in_a_cylinder_has_points_in_its_coordinates(read):
    """By hand: r, θ, z of the cylinder about the basic z; the inner one's x is then along -y."""
    outer = frame_18(1, 1, 0, [0, 0, 0], [1, 0, 0], [0, 0, 1])
    inner = frame_18(2, 0, 1, [2, 90, 0], [1, 90, 0], [2, 90, 1])
    component = read(outer + inner + nodes_15([1], [[0.5, 0, 0]], 2, 2))
    np.testing.assert_allclose(component.nodes, [[0, 1.5, 0]], atol=1e-12)


def test_a_trace_line_may_have_more_nodes_than_it_says(read):
    """As Test.Lab writes some: seven for each line of eight."""
    nodes = "".join(f"{n:10d}" for n in (1, 2, 0, 3, 4, 1, 0, 0))
    line = block(82, f"{1:10d}{4:10d}{8:10d}", "NONE", nodes)
    component = read(
        nodes_15([1, 2, 3, 4], SQUARE) + line.replace("         7         8", "         4         8")
    )
    assert component.elements["line"].tolist() == [[0, 1], [2, 3], [3, 0]]


def test_systems_that_stand_in_many_others_are_refused(read):
    frames = [frame_18(n, 0, n + 1, [0, 0, 0], [1, 0, 0], [0, 0, 1]) for n in range(1, 2000)]
    with pytest.raises(VehicleError, match="or in too many others"):
        read("".join(frames) + nodes_15([1], [[0.5, 0, 0]], 1, 1))


@pytest.mark.parametrize("write", [shape_55, shape_2414])
def test_a_normal_mode_in_complex_numbers_is_real(read, write):
    """As Simcenter writes it: data that are complex, of an analysis of normal modes."""
    shape = np.arange(12.0).reshape(4, 3) + 0j
    text = nodes_2411([1, 2, 3, 4], SQUARE) + write([1, 2, 3, 4], shape, 12.5, 3.5)
    component = read(text)
    assert not component.is_complex


@pytest.mark.parametrize("end", [b"", b"\n"])
def test_binary_data_sets_are_gone_over_by_their_length(read, end):
    """Whatever stands in them, and whether or not their bytes end a line."""
    raw = b"\0\1\n    -1\n  2411\n" + bytes(14)
    head = (
        f"    -1\n    58b     1     2          11{len(raw):12d}     0     0           0           0\n"
    )
    text = head.encode() + 11 * b"NONE\n" + raw + end + b"    -1\n"
    after = nodes_15([1], [[0.5, 0, 0]]).encode()
    component = read(text + after)
    assert component.node_ids.tolist() == [1]
    assert component.notes == ("data sets left out, which are no part of modes: 1 of 58b",)
    for length in (99999999999, 10**30):
        with pytest.raises(VehicleError, match="the file is cut"):
            read(text.replace(f"{len(raw):12d}".encode(), f"{length:12d}".encode()) + after)
    with pytest.raises(VehicleError, match="the file is cut"):  # found at random
        read(b"    -1\n    58b\nNONE\n")


@pytest.mark.parametrize("write", ["18", "2420"])
def test_motions_along_a_cylinder_are_turned_at_each_node(read, write):
    if write == "18":
        frame = frame_18(3, 1, 0, [0, 0, 0], [1, 0, 0], [0, 0, 1])
    else:
        frame = frame_2420(3, 1, np.eye(3), [0, 0, 0])
    text = frame + nodes_15([1, 2], [[2.0, 90, 5], [2.0, 180, 5]], 3, 3)
    component = read(text + shape_55([1, 2], np.tile([[1.0, 2, 3]], (2, 1)), 5.0))
    np.testing.assert_allclose(component.nodes, [[0, 2, 5], [-2, 0, 5]], atol=1e-9)
    np.testing.assert_allclose(component.modes.shapes[:, :3, 0], [[-2, 1, 3], [-1, -2, 3]], atol=1e-9)


def test_places_of_2411_are_basic_ones_whatever_system_their_motions_have(read):
    turned = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    text = frame_2420(4, 0, turned, [9.0, 9, 9]) + nodes_2411([1], [[1.0, 2, 3]], 4, 4)
    component = read(text + shape_55([1], np.array([[1.0, 0, 0, 0, 1, 0]]), 5.0))
    np.testing.assert_array_equal(component.nodes, [[1, 2, 3]])
    np.testing.assert_allclose(component.modes.shapes[0, :, 0], [0, 1, 0, -1, 0, 0], atol=1e-12)


def test_a_system_that_is_not_there_is_taken_for_the_basic_one_and_told(read):
    component = read(nodes_2411([1], [[1.0, 2, 3]], motion=1))
    assert "coordinate systems 1" in component.notes[0]


@pytest.mark.parametrize(
    ("code", "name", "length", "force", "mass"),
    [
        (1, "SI", 1.0, 1.0, 1.0),
        (5, "MM", 1000.0, 1000.0, 1.0),  # mm, mN: kg
        (9, "USER_DEFINED", 1000.0, 1.0, 1000.0),  # mm, N: t
        (7, "IN", 39.37007874, 0.2248089431, 175.126835),  # in, lbf: lbf s²/in
    ],
)
def test_units_say_how_many_of_them_one_of_si_is(read, code, name, length, force, mass):
    units = read(units_164(code, name, length, force) + nodes_15([1], SQUARE[:1])).units
    assert units.name == name
    assert units.length == pytest.approx(1 / length)
    assert units.mass == pytest.approx(mass)


def test_corners_of_elements_with_nodes_between_them(read):
    places = np.random.default_rng(1).random((30, 3))
    labels = np.arange(1, 31)
    elements = [
        (21, (1, 2)), (24, (1, 2, 3)), (91, (1, 2, 3)), (92, tuple(range(1, 7))),
        (94, (1, 2, 3, 4)), (95, tuple(range(1, 9))), (111, (1, 2, 3, 4)),
        (118, tuple(range(1, 11))), (112, tuple(range(1, 7))), (113, tuple(range(1, 16))),
        (115, tuple(range(1, 9))), (116, tuple(range(1, 21))), (161, (1,)),
    ]  # fmt: skip
    component = read(nodes_15(labels, places) + elements_2412(*elements))
    found = {kind: (rows + 1).tolist() for kind, rows in component.elements.items()}
    assert found == {
        "line": [[1, 2], [1, 3]],
        "triangle": [[1, 2, 3], [1, 3, 5]],
        "quad": [[1, 2, 3, 4], [1, 3, 5, 7]],
        "tetra": [[1, 2, 3, 4], [1, 3, 5, 10]],
        "wedge": [[1, 2, 3, 4, 5, 6], [1, 3, 5, 10, 12, 14]],
        "hexa": [[1, 2, 3, 4, 5, 6, 7, 8], [1, 3, 5, 7, 13, 15, 17, 19]],
    }
    assert "1 elements are springs, masses" in component.notes[0]


def group(number, name, *entities):
    """The lines of a group, two entities to a line: format 8I10, and 20A2 for the name."""
    rows = [f"{kind:10d}{label:10d}{0:10d}{0:10d}" for kind, label in entities]
    lines = ["".join(rows[i : i + 2]) for i in range(0, len(rows), 2)]
    return [f"{number:10d}" + f"{0:10d}" * 6 + f"{len(rows):10d}", f"{name:40s}", *lines]


@pytest.mark.parametrize("kind", [2467, 2477])
def test_groups_of_nodes_go_by_their_names(read, kind):
    lines = [
        *group(1, "Left mount", (7, 3), (7, 1), (8, 99)),
        *group(2, "elements", (8, 1)),
        *group(3, "nothing"),
        *group(4, "all", *((7, label) for label in (1, 2, 3, 4))),
    ]
    component = read(block(kind, *lines) + nodes_2411([1, 2, 3, 4], SQUARE))
    nodes = {name: found.nodes for name, found in component.node_sets.items()}
    assert nodes == {"GROUP:Left mount": (3, 1), "GROUP:all": (1, 2, 3, 4)}
    assert not component.notes


def test_groups_that_pyuff_writes_are_read(tmp_path):
    active = {
        f"active_{what}_set_no_for_group": 0
        for what in ("constraint", "restraint", "load", "dof", "temperature", "contact")
    }
    one = {"group_number": 1, "group_name": "Left mount", **active}
    one |= {"entity_type_code": [7, 7, 7], "entity_tag": [3, 1, 4]}
    one |= {"entity_node_leaf_id": [0, 0, 0], "entity_component_id": [0, 0, 0]}
    path = tmp_path / "a.unv"
    pyuff.UFF(str(path)).write_sets([{"type": 2467, "groups": [one]}], mode="overwrite")
    path.write_text(path.read_text() + nodes_2411([1, 2, 3, 4], SQUARE))
    assert read_universal([path]).node_sets["GROUP:Left mount"].nodes == (3, 1, 4)


@pytest.mark.parametrize("count", ["-3", "9", "999999999", "x"])
def test_damaged_groups_are_left_out_and_told(read, count):
    lines = group(1, "a", (7, 1), (7, 2))
    lines[0] = lines[0][:70] + f"{count:>10}"
    component = read(block(2467, *lines) + nodes_2411([1, 2, 3, 4], SQUARE))
    assert component.node_sets == {}
    assert "1 of 2467" in component.notes[0]


def test_titles_in_latin_1_and_line_ends_of_dos_do_no_harm(read):
    text = shape_55([1], np.ones((1, 3)), 10.0, titles="Träger, größte Auslenkung é")
    assert read(text.replace("\n", "\r\n")).modes.frequency_hz.tolist() == [10]


def test_other_data_sets_are_left_out_and_told(read):
    component = read(nodes_15([1], SQUARE[:1]) + block(58, "some function") + block(2467, "group"))
    assert "1 of 58, 1 of 2467" in component.notes[0]


def test_what_pyuff_writes_is_read(tmp_path):
    shape = np.array([[0.1, -0.2, 0.3], [4e-7, 5, -6e5]])
    path = tmp_path / "a.uff"
    one = {"type": 15, "node_nums": [3, 8], "def_cs": [0, 0], "disp_cs": [0, 0], "color": [1, 1]}
    places = {"x": [1.0, 2.0], "y": [3.0, 4.0], "z": [5.0, -6e-3]}
    mode = pyuff.prepare_55(
        model_type=1, id1="a", id2="b", id3="c", id4="d", id5="e", analysis_type=2, data_ch=2,
        spec_data_type=8, data_type=2, load_case=1, mode_n=1, freq=33.25, modal_m=0.5,
        modal_damp_vis=0.01, modal_damp_his=0.0, node_nums=np.array([3, 8]),
        r1=shape[:, 0], r2=shape[:, 1], r3=shape[:, 2],
    )  # fmt: skip
    pyuff.UFF(str(path)).write_sets([one | places, mode], mode="overwrite")
    component = read_universal([path])
    np.testing.assert_allclose(component.nodes, [[1, 3, 5], [2, 4, -6e-3]])
    np.testing.assert_allclose(component.modes.shapes[:, :3, 0], shape, rtol=1e-5)
    assert component.modes.modal_mass.tolist() == [0.5]
    assert component.modes.frequency_hz.tolist() == [33.25]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "no data set"),
        ("hello", "no data set"),
        (nodes_15([1, 1], SQUARE[:2]), "node 1 is there twice, at different places"),
        (nodes_15([1], [[np.nan, 0, 0]]), "not finite"),
        (nodes_15([1], [[0.0, 0, 0]])[:-8], "the file is cut"),
        (shape_55([1, 2], np.ones((2, 3)), 10.0)[:-30], "the file is cut"),
        (shape_55([1], np.full((1, 3), np.nan), 10.0), "not finite"),
        (shape_55([1], np.full((1, 3), -1e20), 10.0), "beyond 1e+15"),
        (shape_55([1], np.full((1, 3), 1e20j), [1.0] * 6, analysis=3), "beyond 1e+15"),
        (shape_55([1], np.ones((1, 3)), np.inf), "a mode of inf Hz"),
        (shape_55([1], np.ones((1, 3)), -1.0), "a mode of -1 Hz"),
        (shape_55([1, 1], np.ones((2, 3)), 5.0), "moves a node twice"),
        (shape_55([1], np.ones((1, 3)), 5.0).replace("         1\n", "       1.5\n"), "1.5"),
        (shape_55([1], np.ones((1, 3)), 5.0).replace(" 1.00000E+00\n", " 1.00000\n 2.0\n"), "cut"),
        (shape_55([1], np.ones((1, 3)), 5.0).replace("E+00", "?+00"), "expected a number"),
        (block(55, "a", "b"), "found 2 lines, expected at least 6"),
        (block("abc"), "expected the number of a data set"),
        (block(82, "         1 999999999         8", "name", "         1         2"), "999999999"),
        (block(2412, "1 94 1 1 7 99999999", "1 2 3 4"), "4 nodes of 99999999"),
        (nodes_15([1], SQUARE[:1]) + elements_2412((91, (1, 2, 3))), "node 2 is named"),
        (elements_2412((94, (1, 2, 3))), "too few for a quad"),
        (frame_18(1, 0, 0, [0, 0, 0], [1, 0, 0], [2, 0, 0]), "on a line"),
        (frame_18(1, 7, 0, [0, 0, 0], [1, 0, 0], [0, 0, 1]), "of kind 7"),
        (frame_18(1, 0, 1, [0, 0, 0], [1, 0, 0], [0, 0, 1]), "is given in itself"),
        (frame_18(1, 0, 0, [0] * 6, [0] * 9, [1] * 3), "18 numbers of a coordinate system"),
        (frame_2420(1, 0, 2 * np.eye(3), [0, 0, 0]), "not at right angles"),
        (units_164(9, "NONE", 0.0, 1.0), "above zero"),
    ],
)
def test_damaged_files_are_refused_in_a_sentence(read, text, words):
    with pytest.raises(VehicleError) as caught:
        read(text)
    assert words in str(caught.value)
    assert ": :" not in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1
