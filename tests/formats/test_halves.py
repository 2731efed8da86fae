"""Symmetric and antisymmetric runs of a half model, joined, against the whole model."""

import re
from dataclasses import replace

import numpy as np
import pytest
from half_models import full_mesh, run
from universal_files import elements_2412, nodes_2411, shape_2414

from modeviz.cli import main
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.formats.attachments import find_attachments
from modeviz.formats.body import flexible_body
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.formats.halves import MIRRORED, Plane, join_halves, parse_plane
from modeviz.formats.places import parse_place
from modeviz.formats.surface import outer_triangles
from modeviz.vehicle.connections import Spring
from modeviz.vehicle.vehicle import Vehicle

SI = UNIT_SYSTEMS["m-kg-s"]
BESIDE = np.array([0, 0.2, 0])
LEFT = np.array([0.0, -1, 0])
N = 40
ATTACH = ("corner=6", "rear=54@1.5,0.5,0.1", "pad=mean:20,21,26,27", "nose=1")


@pytest.fixture(scope="module")
def halves():
    return tuple(run(name).component() for name in ("symmetric", "antisymmetric"))


@pytest.fixture(scope="module")
def whole(halves):
    return join_halves(*halves, Plane(1))


@pytest.fixture(scope="module")
def joined(whole):
    places = [parse_place(text) for text in ATTACH]
    found = whole.attachments(find_attachments(whole.component, places, SI), LEFT, 1.0)
    return flexible_body(whole.component, SI, "sheet", found)[0].truncated(N)


@pytest.fixture(scope="module")
def full(whole):
    """The full model's body, with the same attachments on both sides, named by hand."""
    component = run("free", 60).component()
    order = np.arange(1, len(full_mesh()[0]) + 1)
    image = order[whole.image]
    texts = [
        *("corner right=6", f"corner left={image[5]}"),
        *("rear right=54@1.5,0.5,0.1", f"rear left={image[53]}@1.5,-0.5,0.1"),
        "pad right=mean:20,21,26,27",
        f"pad left=mean:{','.join(str(image[i - 1]) for i in (20, 21, 26, 27))}",
        "nose=1",
    ]
    found = find_attachments(component, [parse_place(text) for text in texts], SI)
    return flexible_body(component, SI, "sheet", found)[0].truncated(N)


def held(body) -> Vehicle:
    """On springs at all its attachments, of which no two are alike."""
    springs = tuple(
        Spring(
            a.name,
            "s",
            ("sheet", "ground"),
            np.tile(a.position, (2, 1)),
            stiffness=2e4 * np.array([1 + i, 2.5 - 0.3 * i, 1.7]),
        )
        for i, a in enumerate(body.attachments)
    )
    return Vehicle("v", (body,), springs)


def test_the_whole_has_the_modes_of_the_full_model(whole, joined, full):
    np.testing.assert_allclose(joined.natural_frequency_hz, full.natural_frequency_hz, rtol=1e-9)
    np.testing.assert_array_equal(whole.component.nodes, full_mesh()[0])
    assert joined.n_rigid == 6
    np.testing.assert_allclose(joined.mass, full.mass, rtol=1e-9)
    inertias = [body.rigid_fit.mass_about_center_of_gravity[1] for body in (joined, full)]
    np.testing.assert_allclose(*inertias, atol=1e-9 * inertias[1].max())


def test_coupled_to_others_it_has_the_frequencies_of_the_full_model(joined, full):
    names = [a.name for a in full.attachments]
    joined = replace(joined, attachments=tuple(joined.attachment(name) for name in names))
    found, expected = (solve_modes(assemble(held(b))).frequency_hz for b in (joined, full))
    np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_attachments_of_both_sides_move_as_those_of_the_full_model(joined, full):
    """Their static flexibility, all six directions against all others: modes may have either sign."""
    flexibilities = []
    for body in (joined, full):
        phi = np.vstack([body.attachment(a.name).shapes for a in full.attachments])[:, 6:]
        flexibilities.append(phi / body.omega_n_squared[6:] @ phi.T)
    scale = np.sqrt(np.diag(flexibilities[1]))
    off = (flexibilities[0] - flexibilities[1]) / np.outer(scale, scale)
    np.testing.assert_allclose(off, 0, atol=1e-8)


def test_attachments_are_named_by_their_side_and_those_in_the_plane_are_one(joined):
    assert {a.name for a in joined.attachments} == {
        *("corner left", "corner right", "rear left", "rear right", "pad left", "pad right", "nose"),
    }
    for attachment in joined.attachments:
        side = np.sign(attachment.position[1].round(12))
        assert {"left": -1, "right": 1}.get(attachment.name.split()[-1], 0) == side


def test_sides_go_by_the_way_that_is_left(whole):
    found = find_attachments(whole.component, [parse_place("a=6")], SI)
    names = [one.name for one in whole.attachments(found, -LEFT, 1.0)]
    assert names == ["a left", "a right"]
    names = [one.name for one in whole.attachments(found, np.array([1.0, 0, 0]), 1.0)]
    assert names == ["a", "a image"]


def test_a_set_of_nodes_on_both_sides_is_its_own_image(whole):
    ids = whole.component.node_ids
    both = [5, 6, 11, *(ids[whole.image[i]] for i in (4, 5, 10))]
    place = parse_place(f"beam=mean:{','.join(map(str, both))}")
    (one,) = whole.attachments(find_attachments(whole.component, [place], SI), LEFT, 1.0)
    assert one.name == "beam"


def test_images_of_elements_have_their_faces_outside_and_none_between_the_halves():
    """A solid of each kind beside the plane: the volume within its surface doubles."""
    corners = np.array(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1.0]]
    )
    solids = {
        "hexa": [0, 1, 2, 3, 4, 5, 6, 7],
        "wedge": [0, 1, 3, 4, 5, 7],
        "pyramid": [0, 1, 5, 4, 3],
        "tetra": [0, 1, 3, 4],
    }
    for kind, rows in solids.items():
        places = np.vstack([corners, Plane(1).image(corners)])
        image = 8 + np.array(rows)[list(MIRRORED[kind])]
        volumes = []
        for elements in ([rows], [rows, image]):
            a, b, c = places[outer_triangles({kind: np.array(elements)})].swapaxes(0, 1)
            volumes.append(np.sum(a * np.cross(b, c)) / 6)
        assert volumes[1] == pytest.approx(2 * volumes[0])
        assert abs(volumes[0]) > 0.1


def test_any_plane_may_be_the_one(halves):
    """The structure turned and moved, so that y is z and the plane is at 0.3 m."""
    turn = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])

    def turned(half):
        shapes = np.concatenate([turn @ half.modes.shapes[:, :3], turn @ half.modes.shapes[:, 3:]], 1)
        places = half.nodes @ turn.T + [0, 0, 0.3]
        return replace(half, nodes=places, modes=replace(half.modes, shapes=shapes))

    whole = join_halves(*map(turned, halves), parse_plane("z = 0.3"))
    assert whole.component.nodes[:, 2].min() == pytest.approx(0.3 - 0.45)
    found = find_attachments(whole.component, [parse_place("a=6")], SI)
    (one, other) = whole.attachments(found, LEFT, 1.0)
    np.testing.assert_allclose(other.position, one.position * [1, 1, -1] + [0, 0, 0.6])


def changed(half, **modes):
    return replace(half, modes=replace(half.modes, **modes))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda s, a: (a, s), "the symmetric run, .*SPC 246.*exchanged"),
        (lambda s, a: (s, s), "the antisymmetric run, .*SPC 135.*exchanged"),
        (lambda s, a: (s, replace(a, node_ids=a.node_ids + 1)), "2 nodes are in one of them alone"),
        (lambda s, a: (s, replace(a, nodes=a.nodes * [1, 1, 1.1])), "node .* is at two places"),
        (
            lambda s, a: tuple(replace(h, nodes=h.nodes + BESIDE) for h in (s, a)),
            "no node is in the plane y = 0, the nearest is 0.2 away",
        ),
        (
            lambda s, a: tuple(replace(h, nodes=h.nodes - BESIDE) for h in (s, a)),
            "on both sides of the plane y = 0, from -0.2 to 0.25",
        ),
        (
            lambda s, a: (changed(s, frequency_hz=s.modes.frequency_hz + 1.0), a),
            "the symmetric run, .* has 0 modes near zero Hz, expected the three",
        ),
        (lambda s, a: (s, changed(a, shapes=a.modes.shapes * (1 + 0j))), "has complex modes"),
        (
            lambda s, a: (s, changed(a, shapes=a.modes.shapes[..., :0], frequency_hz=np.zeros(0))),
            "the antisymmetric run, .* has no modes",
        ),
    ],
)
def test_what_are_no_two_runs_of_a_half_is_refused(halves, change, words):
    with pytest.raises(VehicleError, match=words) as caught:
        join_halves(*change(*halves), Plane(1))
    assert len(str(caught.value).splitlines()) == 1


@pytest.mark.parametrize("text", ["", "w=0", "y=nan", "y=x", "yz=1", "1"])
def test_wrong_planes_are_refused(text):
    with pytest.raises(VehicleError, match="expected such as y=0"):
        parse_plane(text)


@pytest.fixture
def files(tmp_path):
    """Universal files of both runs, in mm and t."""
    paths = []
    for name in ("symmetric", "antisymmetric"):
        one = run(name)
        labels = np.arange(1, len(one.nodes) + 1)
        quads = [(94, tuple(labels[corners])) for corners in one.quads]
        text = nodes_2411(labels, 1000 * one.nodes) + elements_2412(*quads)
        scale = np.repeat([1.0, 1e-3], 3) * np.sqrt(1000)  # of 1/√kg and 1/(m √kg)
        for mode in range(20):
            text += shape_2414(labels, scale * one.shapes[:, :, mode], abs(one.frequency_hz[mode]), 1.0)
        paths.append(tmp_path / f"{name}.unv")
        paths[-1].write_text(text)
    return paths


def test_a_command_joins_two_runs_to_a_body(tmp_path, files, full, capsys):
    folder = tmp_path / "vehicle"
    common = [
        "--output",
        str(folder),
        "--units",
        "mm-t-s",
        "--attach",
        "corner=6",
        "--attach",
        "nose=1",
    ]
    status = main(["import", str(files[0]), *common, "--antisymmetric", str(files[1])])
    assert status == 0
    (body,) = read_vehicle(folder).bodies
    assert [a.name for a in body.attachments] == ["corner right", "corner left", "nose"]
    expected = full.natural_frequency_hz[6:30]
    np.testing.assert_allclose(body.natural_frequency_hz[6:30], expected, rtol=1e-5)
    assert body.mass == pytest.approx(full.mass, rel=1e-4)
    said = capsys.readouterr()
    assert "6 rigid and 34 elastic modes" in said.out
    assert re.search(r"centre of gravity \[[-0-9.]+, 0, [0-9.]+\] m", said.out)
    assert "left is where y is below zero" in said.err
    assert "symmetric.unv and antisymmetric.unv" in (folder / "vehicle.toml").read_text()


def test_sides_of_a_command_go_by_the_axes_of_the_vehicle(tmp_path, files):
    folder = tmp_path / "vehicle"
    folder.mkdir()
    (folder / "vehicle.toml").write_text('name = "v"\naxes = "x forward, y left, z up"\n')
    common = ["--output", str(folder), "--units", "mm-t-s", "--attach", "corner=6"]
    main(["import", str(files[0]), *common, "--antisymmetric", str(files[1])])
    (body,) = read_vehicle(folder).bodies
    assert body.attachment("corner left").position[1] < 0  # ours: y is to the right


def test_sides_of_a_command_go_by_the_pose(tmp_path, files, capsys):
    folder = tmp_path / "vehicle"
    common = ["--output", str(folder), "--units", "mm-t-s", "--attach", "corner=6"]
    pose = ["--pose", "x forward, y left, z up at 100,0,0"]
    main(["import", str(files[0]), *common, *pose, "--antisymmetric", str(files[1])])
    (body,) = read_vehicle(folder).bodies
    left = body.attachment("corner left").position
    np.testing.assert_allclose(left, run("symmetric").nodes[5] * [-1, -1, 1] + [0.1, 0, 0], atol=1e-6)
    assert "left is where" not in capsys.readouterr().err


def test_a_run_whose_modes_end_far_below_the_others_is_told(halves):
    symmetric, antisymmetric = halves
    fewer = changed(
        antisymmetric,
        shapes=antisymmetric.modes.shapes[..., :12],
        **{
            name: getattr(antisymmetric.modes, name)[:12]
            for name in ("frequency_hz", "modal_mass", "damping_ratio")
        },
    )
    (note,) = join_halves(symmetric, fewer, Plane(1)).component.notes
    assert "the modes of the antisymmetric run end at" in note
    assert not join_halves(*halves, Plane(1)).component.notes


def test_residual_vectors_of_both_halves_come_last(halves):
    symmetric, antisymmetric = (
        changed(half, n_residuals=n) for half, n in zip(halves, (2, 3), strict=True)
    )
    modes = join_halves(symmetric, antisymmetric, Plane(1)).component.modes
    assert modes.n_residuals == 5
    tops = [half.modes.frequency_hz[-n:] for half, n in zip(halves, (2, 3), strict=True)]
    np.testing.assert_array_equal(modes.frequency_hz[-5:], np.sort(np.concatenate(tops)))
    assert (np.diff(modes.frequency_hz[:-5]) >= 0).all()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--plane", "y=0"], "--plane is of two halves"),
        (["--antisymmetric", "none.unv"], "--antisymmetric: "),
        (
            ["--antisymmetric", "{0}"],
            "--antisymmetric: the antisymmetric run, symmetric.unv, moves node",
        ),
        (["--antisymmetric", "{1}", "--plane", "y=-5"], "no node is in the plane y = -5"),
        (["--antisymmetric", "{1}", "--plane", "q"], "--plane: found 'q'"),
    ],
)
def test_wrong_halves_are_refused(tmp_path, files, capsys, options, words):
    folder = tmp_path / "vehicle"
    given = [option.format(*files) for option in options]
    status = main(["import", str(files[0]), "--output", str(folder), "--units", "mm-t-s", *given])
    assert status == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert words in line
    assert not folder.exists()


def test_a_half_by_itself_says_that_it_is_one(files, tmp_path, capsys):
    status = main(["import", str(files[0]), "--output", str(tmp_path / "vehicle"), "--units", "mm-t-s"])
    assert status == 2
    assert "--antisymmetric" in capsys.readouterr().err
