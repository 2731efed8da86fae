import numpy as np
import pytest
from free_network import CORNERS, LABELS, free_network
from network_files import network_unv
from op2_files import Op2
from scipy.linalg import eigh

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.formats.attachments import find_attachments
from modeviz.formats.component import UNIT_SYSTEMS, Component, Modes
from modeviz.formats.nastran import read_nastran
from modeviz.formats.node_sets import NodeSet, set_motion
from modeviz.formats.places import parse_place
from modeviz.vehicle.rigid import rigid_motions

POINT = np.array([0.3, -0.2, 0.9])


def component(places, turns=True, **others):
    """Nodes 1, 2, … that move at random in seven modes, with rotations or without."""
    shapes = np.random.default_rng(3).standard_normal((len(places), 6, 7))
    shapes[:, 3:] *= turns
    none = np.full(7, np.nan)
    modes = Modes(np.arange(7.0), none, none, shapes)
    return Component(np.arange(1, len(places) + 1), places, {}, modes, **others)


def found(component, *texts, units="m-kg-s"):
    return find_attachments(component, [parse_place(t) for t in texts], UNIT_SYSTEMS[units])


@pytest.fixture
def places():
    return np.random.default_rng(4).random((9, 3))


@pytest.mark.parametrize("where", ["a=4", "a=4@1,2,3", "a=mean:1,2,5-8", "a=rigid:1,2,3@.5,0,9"])
@pytest.mark.parametrize("units", ["m-kg-s", "mm-t-s"])
def test_an_attachment_moves_with_a_rigid_component_as_a_point_of_it(places, where, units):
    (one,) = found(component(places), where, units=units)
    length = UNIT_SYSTEMS[units].length
    motions = rigid_motions(length * places - POINT)
    np.testing.assert_allclose(
        one.shapes(motions), rigid_motions(one.position - POINT), rtol=1e-9, atol=1e-9
    )
    if "@" in where:
        there = [float(v) for v in where.partition("@")[2].split(",")]
        np.testing.assert_allclose(one.position, np.multiply(there, length))


def test_a_mean_loads_its_nodes_with_their_share_and_with_what_the_moment_asks(places):
    """RBE3 of Nastran: F w/W + w (I⁻¹ M) × r about their middle."""
    weights = np.linspace(1, 3, 9)
    force, moment = np.array([3.0, -1, 2]), np.array([0.5, 0.7, -0.4])
    middle = weights @ places / weights.sum()
    r = places - middle
    about = moment + np.cross(POINT - middle, force)
    inertia = np.einsum("i,ijk->jk", weights, (r**2).sum(1)[:, None, None] * np.eye(3))
    inertia -= np.einsum("i,ij,ik->jk", weights, r, r)
    turning = np.cross(np.linalg.solve(inertia, about), r)
    expected = weights[:, None] * (force / weights.sum() + turning)
    motion = set_motion(POINT, places, weights, turns=False)
    loads = (motion.T @ np.r_[force, moment]).reshape(9, 6)
    np.testing.assert_allclose(loads[:, :3], expected, atol=1e-12)
    assert not loads[:, 3:].any()


def test_rotations_count_on_a_rigid_set_and_not_in_a_mean(places):
    one = component(places)
    shapes = one.modes.shapes
    mean, rigid = (found(one, f"a={kind}:1-5")[0].shapes(shapes) for kind in ("mean", "rigid"))
    still = shapes.copy()
    still[:, 3:] = 0
    np.testing.assert_allclose(found(one, "a=mean:1-5")[0].shapes(still), mean)
    assert np.abs(rigid - mean).max() > 0.01


def test_two_nodes_with_rotations_carry_a_point_rigidly(places):
    (one,) = found(component(places), "a=rigid:2,7")
    np.testing.assert_allclose(one.shapes(rigid_motions(places - one.position)), np.eye(6), atol=1e-12)


@pytest.mark.parametrize(
    ("text", "turns", "words"),
    [
        ("a=mean:1,2", True, "its 2 nodes tell no rotation about the line"),
        ("a=mean:1,2,3", True, "its 3 nodes tell no rotation about the line"),
        ("a=rigid:1,2,3", False, "its 3 nodes tell no rotation about the line"),
        ("a=mean:1,2,77", True, "there is no node 77"),
        ("a=RBE2:5", True, "unknown set of nodes 'RBE2:5': there are none"),
        ("a=mean:", True, "expected a node's number"),
        ("a=mean:5-2", True, "expected a node's number"),
        ("a=rigid:1,x", True, "expected a node's number"),
        ("a=1@2,3", True, "expected a node's number"),
        ("a=1,2,3@4,5,6", True, "expected a node's number"),
        ("mean:1,2,4", True, "expected a node's number"),
    ],
)
def test_sets_that_carry_no_point_are_refused(text, turns, words):
    line = component(np.array([[0.0, 0, 0], [1, 1, 1], [2, 2, 2], [0, 5, 0]]), turns)
    with pytest.raises(VehicleError) as caught:
        found(line, text)
    assert words in str(caught.value)


def test_a_spring_on_a_set_pulls_on_the_full_matrices_as_its_transpose(tmp_path, printed_json):
    """At a point outside of them, so that lever arms count, of nodes that do not turn."""
    network = free_network()
    at = np.array([1100.0, 300, 150])
    (tmp_path / "block.unv").write_text(network_unv())
    folder = tmp_path / "vehicle"
    attach = [
        *("--attach", "rear=mean:12,14,22,24@1100,300,150"),
        *("--attach", "11", "--attach", "13"),
    ]
    files = ["import", str(tmp_path / "block.unv"), "--output", str(folder), "--units", "mm-t-s"]
    assert main([*files, *attach]) == 0
    with (folder / "vehicle.toml").open("a") as toml:
        for name, place, stiffness in [
            ("a", at, 40.0),
            ("b", CORNERS[0], 30.0),
            ("c", CORNERS[2], 20.0),
        ]:
            toml.write(
                f'[[spring]]\nname = "{name}"\nbodies = ["block", "ground"]\n'
                f"at = {(place / 1000).tolist()}\nstiffness = {[stiffness] * 3}\n"
            )
    modes = printed_json("modes", str(folder), "--below", "1000")["modes"]
    G = rigid_motions(CORNERS[LABELS % 10 % 2 == 0] - at)[:, :3].reshape(12, 6)
    B = np.zeros((3, 8, 3))
    B[:, LABELS % 10 % 2 == 0] = np.linalg.pinv(G)[:3].reshape(3, 4, 3)
    B = B.reshape(3, 24)
    K = network.stiffness + 40 * B.T @ B
    K[range(9), range(9)] += np.repeat([30, 0, 20], 3)
    expected = np.sqrt(eigh(K, network.mass, eigvals_only=True)) / (2 * np.pi)
    np.testing.assert_allclose([m["frequency_hz"] for m in modes], expected, rtol=1e-4)


def test_a_set_that_is_to_be_rigid_and_is_not_is_told(tmp_path, capsys):
    (tmp_path / "block.unv").write_text(network_unv())
    files = ["import", str(tmp_path / "block.unv"), "--units", "mm-t-s", "--output"]
    attach = ["--attach", "rear=rigid:12,14,22,24"]
    assert main([*files, str(tmp_path / "vehicle"), *attach]) == 0
    assert (
        "the nodes of 'rear' are to be one rigid piece, and part from it by" in capsys.readouterr().err
    )


def test_a_set_of_the_component_goes_by_its_name_and_may_be_joined_otherwise(places):
    one = component(places, node_sets={"GROUP:left mount": NodeSet("mean", (1, 2, 5))})
    mean, rigid = found(one, "a=group:Left Mount", "b=rigid:GROUP:left mount@0,0,0")
    (expected,) = found(one, "a=rigid:1,2,5@0,0,0")
    assert (mean.is_rigid, rigid.is_rigid) == (False, True)
    np.testing.assert_array_equal(mean.rows, [0, 1, 4])
    np.testing.assert_array_equal(rigid.motion, expected.motion)


DECK = """BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,2.,0.,0.
GRID,3,,2.,3.,0.
GRID,4,,0.,3.,0.
GRID,9,,1.,1.,5.
RBE2,901,9,123456,1,2,3,4
RBE3,77,,9,123456,1.,123,1,2,
,2.5,123,3,4
RBE3,78,,9,123456,1.,12,1,2,3
SET1,5,1,THRU,3,9
ENDDATA
"""


@pytest.mark.parametrize(("order", "size"), [("<", 4), (">", 4), ("<", 8)])
@pytest.mark.parametrize("after", [(), (0.0,), (1e-5, 20.0)])
def test_sets_of_an_op2_file_are_those_of_its_deck(tmp_path, order, size, after):
    """With none, one or two words after each element, as versions have them."""
    op2 = Op2(order, size)
    places = [(1, 0, 0), (2, 2, 0), (3, 2, 3), (4, 0, 3)]
    grids = [(i, 0, (x, y, 0), 0) for i, x, y in places] + [(9, 0, (1, 1, 5), 0)]
    rigid = [901, 9, 123456, 1, 2, 3, 4, -1, *after, 902, 1, 12, 2, -1, *after]
    mean = [77, 9, 123456, 1.0, 123, 1, 2, -1, 2.5, 123, 3, 4, -1, -2, 4, 3, -3, *after]
    others = [78, 9, 123456, 1.0, 12, 1, 2, 3, -1, -3, *after]
    (tmp_path / "a.op2").write_bytes(
        op2.file(
            op2.table("GEOM1", op2.grids(grids)),
            op2.table(
                "GEOM4", op2.words(6901, 69, 295, *rigid), op2.words(7101, 71, 187, *mean, *others)
            ),
        )
    )
    (tmp_path / "a.bdf").write_text(DECK)
    deck = {
        name: s for name, s in read_nastran([tmp_path / "a.bdf"]).node_sets.items() if "RBE" in name
    }
    assert read_nastran([tmp_path / "a.op2"]).node_sets == deck
    assert set(deck) == {"RBE2:901", "RBE3:77"}


def test_damaged_sets_of_an_op2_file_are_left_out(tmp_path):
    op2 = Op2()
    for words in (
        [901],
        [901, 9, 123456, 1, 2],
        [901, 9, 7, 1, -1],
        [-1, -1, -1, -1],
        [1, 2, 3, -5, -1],
    ):
        (tmp_path / "a.op2").write_bytes(
            op2.file(
                op2.table("GEOM1", op2.grids([(1, 0, (0, 0, 0), 0)])),
                op2.table("GEOM4", op2.words(6901, 69, 295, *words)),
            )
        )
        assert read_nastran([tmp_path / "a.op2"]).node_sets == {}


def test_sets_of_a_nastran_deck_go_by_their_cards(tmp_path):
    path = tmp_path / "a.bdf"
    path.write_text(DECK)
    one = read_nastran([path])
    two, three, listed = found(one, "a=RBE2:901", "b=rbe3:77", "c=SET1:5@0,0,0")
    np.testing.assert_allclose(two.position, [1, 1, 5])
    assert one.node_ids[two.rows].tolist() == [9, 1, 2, 3, 4]
    assert one.node_ids[three.rows].tolist() == [1, 2, 3, 4]
    lift = three.motion[2].reshape(4, 6)[:, 2]  # of the point, per lift of each grid
    x, y, w = one.nodes[three.rows, 0], one.nodes[three.rows, 1], np.array([1, 1, 2.5, 2.5])
    A = np.column_stack([np.ones(4), x - 1, y - 1])
    np.testing.assert_allclose(lift, np.linalg.solve(A.T @ (w[:, None] * A), A.T * w)[0], atol=1e-12)
    assert one.node_ids[listed.rows].tolist() == [1, 2, 3, 9]
    with pytest.raises(VehicleError, match="RBE3:78': did you mean 'RBE3:77'"):
        found(one, "a=RBE3:78")
