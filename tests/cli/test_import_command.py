import re
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from free_network import CORNERS, LABELS, MASSES, free_network, held_frequencies
from network_files import network_op2, network_unv
from op2_files import Op2
from oracles import Beam
from universal_files import nodes_2411, shape_55, shape_2414, units_164

from modeviz.cli import main
from modeviz.cli.importing.summary import summary
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.formats.attachments import Found
from modeviz.formats.imported import import_component
from modeviz.units import INCH, POUND, STANDARD_GRAVITY

SHARED = Path(__file__).parents[3] / "shared/data/s2_uff_test_models"


@pytest.fixture
def file(tmp_path):
    def file(text, name="block.unv"):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return str(path)

    return file


def refused(capsys, *arguments):
    """The sentence with which a command is refused."""
    capsys.readouterr()
    assert main(["import", *map(str, arguments)]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert "Traceback" not in "".join(lines)
    return lines[-1]


def uncommented(path: Path) -> None:
    """Takes the "#" off every table that is there to be filled in."""
    lines = path.read_text().splitlines()
    kept = [line.removeprefix("#") if not line.startswith("# ") else line for line in lines]
    path.write_text("\n".join(line for line in kept if not line.startswith("axes")))


MODAL_MASSES = np.geomspace(0.1, 10, 24)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("block.unv", network_unv(MODAL_MASSES, write=shape_55)),
        ("block.unv", network_unv(MODAL_MASSES, write=shape_2414)),
        ("block.op2", network_op2(Op2(), masses=MODAL_MASSES)),
        ("block.op2", network_op2(Op2(">", 8), masses=MODAL_MASSES)),
    ],
)
def test_an_imported_body_on_springs_has_the_frequencies_of_its_full_matrices(
    tmp_path, file, printed_json, name, content
):
    """All its modes are kept, so that only the file's six digits are between them."""
    folder = tmp_path / "vehicle"
    attach = ["--attach", "left=11", "--attach", "rear=24", "--attach", "14"]
    main(["import", file(content, name), "--output", str(folder), "--units", "mm-t-s", *attach])
    springs = {11: 30.0, 24: 50.0, 14: 80.0}
    with (folder / "vehicle.toml").open("a") as toml:
        for name, (label, stiffness) in enumerate(springs.items()):
            place = CORNERS[np.flatnonzero(label == LABELS)[0]] / 1000
            toml.write(
                f'[[spring]]\nname = "{name}"\nbodies = ["block", "ground"]\n'
                f"at = {place.tolist()}\nstiffness = {[stiffness] * 3}\n"
            )
    record = printed_json("modes", str(folder), "--below", "1000")
    found = [mode["frequency_hz"] for mode in record["modes"]]
    expected = held_frequencies(free_network(), springs)
    np.testing.assert_allclose(found, expected[: len(found)], rtol=1e-4)
    assert len(found) == 24


def test_mass_and_centre_of_gravity_are_those_of_the_structure(tmp_path, file, capsys):
    folder = tmp_path / "vehicle"
    arguments = [file(network_unv()), "--output", str(folder), "--units", "mm-t-s"]
    assert main(["import", *arguments]) == 0
    (body,) = read_vehicle(folder).bodies
    assert body.mass == pytest.approx(1000 * MASSES.sum(), rel=1e-4)
    m = body.rigid_fit.mass
    center = MASSES @ CORNERS / MASSES.sum() / 1000
    np.testing.assert_allclose(np.array([m[1, 5], m[2, 3], m[0, 4]]) / body.mass, center, atol=1e-4)
    said = capsys.readouterr().out
    assert f"mass {1000 * MASSES.sum():.3g}" in said
    assert ", ".join(f"{v:.4g}" for v in center) in said


def test_how_stiff_its_modes_make_an_attachment_is_that_of_a_free_body_under_a_force(
    tmp_path, file, capsys
):
    """By the pseudoinverse of K with inertia relief, not by modes; all of them are kept."""
    network = free_network()
    M, K = network.mass, network.stiffness
    R = network.shapes.reshape(24, 24)[:, :6]
    P = np.eye(24) - M @ R @ R.T
    compliance = P.T @ np.linalg.pinv(K, rcond=1e-10) @ P
    row = 3 * int(np.flatnonzero(LABELS == 23)[0])
    expected = 1 / np.diag(compliance)[row : row + 3]
    folder = str(tmp_path / "vehicle")
    main(["import", file(network_unv()), "--output", folder, "--units", "mm-t-s", "--attach", "23"])
    found = re.search(r"modes are \[(.*)\] N/mm stiff there", capsys.readouterr().out)[1]
    np.testing.assert_allclose([float(v) for v in found.split(", ")], expected, rtol=1e-3)


def test_where_no_mode_moves_an_attachment_it_has_no_number_of_stiffness():
    """The lowest modes of a beam are in bending; by rounding they stretch it a little too."""
    body = Beam(10).body("beam", n_modes=9)
    end = body.attachments[0]
    stretched = end.shapes + 1e-12 * np.eye(6, 9, 6)
    body = replace(body, attachments=(replace(end, shapes=stretched),))
    found = Found("end", end.position, np.array([0]), np.eye(6))
    line = summary(body, (found,), Path("v")).splitlines()[-1]
    assert re.search(r"its modes are \[rigid, [\d.]+, [\d.]+\] N/mm stiff there, and about", line)
    assert line.endswith("; no elastic mode moves it along x")


@pytest.mark.parametrize(
    ("name", "length", "mass"),
    [
        ("m-kg-s", 1.0, 1.0),
        ("mm-t-s", 1e-3, 1e3),
        ("mm-kg-mN", 1e-3, 1.0),
        ("in-lbf-s", INCH, POUND * STANDARD_GRAVITY / INCH),
        ("ft-lbf-s", 12 * INCH, POUND * STANDARD_GRAVITY / (12 * INCH)),
    ],
)
def test_units_that_are_named_are_those_of_the_body(tmp_path, file, name, length, mass):
    folder = tmp_path / "vehicle"
    main(["import", file(network_unv()), "--output", str(folder), "--units", name, "--attach", "a=24"])
    (body,) = read_vehicle(folder).bodies
    assert body.mass == pytest.approx(MASSES.sum() * mass, rel=1e-4)
    np.testing.assert_allclose(body.attachment("a").position, CORNERS[-1] * length)


def test_units_that_a_file_says_need_not_be_named_and_are_held_against_the_name(tmp_path, file, capsys):
    path = file(network_unv(units=units_164(9, "USER_DEFINED", 1000.0, 1.0)))
    folder = tmp_path / "vehicle"
    assert main(["import", path, "--output", str(folder)]) == 0
    assert read_vehicle(folder).bodies[0].mass == pytest.approx(1000 * MASSES.sum(), rel=1e-4)
    other = refused(capsys, path, "--output", tmp_path / "other", "--units", "in-lbf-s")
    assert "which in-lbf-s is not" in other


def test_units_are_asked_for_and_not_guessed(tmp_path, file, capsys):
    text = refused(capsys, file(network_unv()), "--output", tmp_path / "vehicle")
    assert "doesn't say its units" in text
    assert "mm-t-s" in text
    unknown = refused(
        capsys, file(network_unv()), "--output", tmp_path / "vehicle", "--units", "furlong"
    )
    assert "found the units 'furlong'" in unknown
    assert not (tmp_path / "vehicle").exists()


def test_attachments_by_node_by_name_and_at_the_nearest_node(tmp_path, file, capsys):
    folder = tmp_path / "vehicle"
    attach = ["--attach", "22", "--attach", "seat=14", "--attach", "left rear = 990, 4, 3"]
    main(["import", file(network_unv()), "--output", str(folder), "--units", "mm-t-s", *attach])
    (body,) = read_vehicle(folder).bodies
    positions = {a.name: (1000 * a.position).round(9).tolist() for a in body.attachments}
    assert positions == {
        "22": [1000, 0, 400],
        "seat": [1000, 700, 0],
        "left rear": [1000, 0, 0],
    }
    distance = np.linalg.norm([10, 4, 3])
    assert f"attachment 'left rear' at [1, 0, 0] m, {distance:.3g} mm" in capsys.readouterr().out


def test_an_attachment_that_lands_far_from_where_it_was_asked_for_has_a_note_of_its_own(
    tmp_path, file, capsys
):
    arguments = [file(network_unv()), "--output", str(tmp_path / "v"), "--units", "mm-t-s"]
    main(["import", *arguments, "--attach", "a=5000,0,0", "--attach", "b=1000,50,0"])
    notes = [line for line in capsys.readouterr().err.splitlines() if "from where it was asked" in line]
    (note,) = notes
    assert "attachment 'a' is 4 m from where it was asked for, at the nearest node, [1, 0, 0] m" in note


def test_a_body_in_wrong_units_is_doubted_as_it_is_imported_and_checked(tmp_path, file, capsys):
    folder = str(tmp_path / "v")
    main(["import", file(network_unv()), "--output", folder, "--units", "m-kg-s"])
    doubt = "body 'block': is 1.28e+03 m across and weighs 0.0142 kg, larger than any part of a vehicle"
    assert doubt in capsys.readouterr().err
    main(["check", folder])
    assert doubt in capsys.readouterr().out


def test_what_is_to_be_filled_in_reads_as_it_stands(tmp_path, file):
    folder = tmp_path / "vehicle"
    arguments = [file(network_unv()), "--output", str(folder), "--units", "mm-t-s", "--attach", "11"]
    main(["import", *arguments])
    assert tomllib.loads((folder / "vehicle.toml").read_text())["name"] == "vehicle"
    uncommented(folder / "vehicle.toml")
    vehicle = read_vehicle(folder)
    assert [g.name for g in vehicle.mount_groups] == ["M1"]
    assert [p.name for p in vehicle.response_points] == ["seat"]
    (tyre,) = vehicle.tyres
    np.testing.assert_allclose(tyre.points[0] - tyre.points[1], [0, 0, 0.3], atol=1e-6)
    assert vehicle.has_driven_tyres
    assert {b.name for b in vehicle.bodies} == {"block", "engine"}


def test_a_second_import_adds_a_body_and_leaves_what_was_written(tmp_path, file):
    folder = tmp_path / "vehicle"
    first = [file(network_unv()), "--output", str(folder), "--units", "mm-t-s"]
    main(["import", *first, "--name", "frame"])
    written = (folder / "vehicle.toml").read_text() + "# mine\n"
    (folder / "vehicle.toml").write_text(written)
    (folder / "notes.txt").write_text("kept")
    main(["import", *first, "--name", "Frame"])
    assert (folder / "vehicle.toml").read_text().startswith(written)
    assert (folder / "notes.txt").read_text() == "kept"
    assert [body.name for body in read_vehicle(folder).bodies] == ["frame", "Frame"]
    assert len(list((folder / "bodies").iterdir())) == 2


def test_a_body_whose_name_is_taken_is_refused_and_nothing_changes(tmp_path, file, capsys):
    folder = tmp_path / "vehicle"
    arguments = [file(network_unv()), "--output", str(folder), "--units", "mm-t-s"]
    main(["import", *arguments])
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert "has a body 'block' already; put this one in its place with --replace" in refused(
        capsys, *arguments
    )
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before
    assert sorted(path.name for path in tmp_path.iterdir()) == ["block.unv", "vehicle"]


MOUNT = """
[[spring]]
name = "M1"
bodies = ["block", "ground"]
at = [0.0, 0.0, 0.0]
stiffness = [50.0, 50.0, 50.0]  # mine
"""


@pytest.fixture
def held(tmp_path, file):
    """A folder with a body that a spring holds at node 11, and what imports it there."""
    folder = tmp_path / "vehicle"
    arguments = [file(network_unv()), "--output", str(folder), "--units", "mm-t-s"]
    main(["import", *arguments, "--attach", "11"])
    path = folder / "vehicle.toml"
    path.write_text(path.read_text().replace('role = "other"', 'role = "frame"') + MOUNT)
    return folder, arguments


def content(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_an_import_tells_nothing_that_stood_before_and_all_of_its_own_body(held, capsys):
    """The one in wrong units is doubted when it comes, and when it is replaced; not by a third one."""
    folder, (path, *arguments) = held
    second = [path, *arguments, "--name", "wrong"]
    second[second.index("mm-t-s")] = "m-kg-s"
    doubt = "body 'wrong': is 1.28e+03 m across"
    for more, is_told in ((second, 1), ([path, *arguments, "--name", "third"], 0)):
        capsys.readouterr()
        assert main(["import", *more]) == 0
        assert capsys.readouterr().err.count(doubt) == is_told
    assert main(["import", *second, "--replace"]) == 0
    assert capsys.readouterr().err.count(doubt) == 1
    table = folder.parent / "mounts.csv"
    table.write_text(
        "name,body 1,body 2,x [mm],y [mm],z [mm],kx [N/mm],ky [N/mm],kz [N/mm]\n"
        "one,block,ground,0,0,0,5,5,5\n"
    )
    assert main(["import", str(table), "--output", str(folder)]) == 0
    assert doubt not in capsys.readouterr().err


def test_a_body_that_replaces_another_has_its_own_modes_and_attachments(tmp_path, file, held):
    folder, (_, *arguments) = held
    before = (folder / "vehicle.toml").read_text()
    fewer = file(network_unv(n_modes=20), "fewer.unv")
    more = ["--attach", "11", "--attach", "seat=14", "--name", "block", "--replace"]
    assert main(["import", fewer, *arguments, *more]) == 0
    (body,) = read_vehicle(folder).bodies
    assert body.n_modes == 20
    assert [a.name for a in body.attachments] == ["11", "seat"]
    assert body.role == "frame"
    after = (folder / "vehicle.toml").read_text()
    own = re.compile(r"(?m)^(# \d+ modes from .*|# attachment .*|#mass .*)\n")
    assert own.sub("", after) == own.sub("", before)
    assert "# 20 modes from fewer.unv" in after
    assert '# attachment "seat"' in after


def test_a_body_whose_forgotten_attachment_comes_may_be_held_there_before(held):
    """The folder cannot be read until then, since a spring holds on to what isn't there."""
    folder, arguments = held
    path = folder / "vehicle.toml"
    path.write_text(path.read_text().replace("at = [0.0, 0.0, 0.0]", "at = [1.0, 0.7, 0.0]"))
    assert main(["import", *arguments, "--attach", "11", "--attach", "14", "--replace"]) == 0
    assert len(read_vehicle(folder).connections) == 1


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--attach", "14"], "[0.0, 0.0, 0.0] is 1.22 m from the nearest attachment of 'block', '14'"),
        ([], "body 'block' has no attachment, so nothing can be connected to it"),
        (["--name", "blokc"], "unknown flexible body 'blokc': did you mean 'block'?"),
    ],
)
def test_a_body_that_cannot_take_the_place_of_another_changes_nothing(held, capsys, more, words):
    folder, arguments = held
    before = content(folder)
    assert words in refused(capsys, *arguments, *more, "--replace")
    assert content(folder) == before


def test_nothing_can_be_replaced_in_a_new_folder(tmp_path, file, capsys):
    folder = tmp_path / "new"
    arguments = [file(network_unv()), "--output", folder, "--units", "mm-t-s", "--replace"]
    assert f"{folder}: has no flexible body; --replace needs one" in refused(capsys, *arguments)
    assert not folder.exists()


def test_replacing_from_python_is_the_same(held):
    folder, (path, *_) = held
    imported = import_component(
        path, output=folder, units="mm-t-s", attach=["11", "seat=14"], replaces=True
    )
    assert [a.name for a in imported.vehicle.body("block").attachments] == ["11", "seat"]


def test_a_body_that_was_not_imported_gets_the_units_and_the_mesh_of_one_that_is(held):
    folder, arguments = held
    path = folder / "vehicle.toml"
    text = path.read_text()
    text = text.replace('"meshes/block.glb"', '"mine.stl"\nmesh_unit = "mm"')
    text = text.replace(
        'units = { length = "m", mass = "kg" }', 'units = { length = "mm", mass = "t" }'
    )
    path.write_text(text.replace("damping_ratio = 0.01", "damping_ratio = [0.02, 0.03]"))
    assert main(["import", *arguments, "--attach", "11", "--replace"]) == 0
    (body,) = read_vehicle(folder).bodies
    assert np.ptp(body.mesh[0].vertices, axis=0) == pytest.approx([1.0, 0.7, 0.4])
    assert body.mass == pytest.approx(1000 * MASSES.sum())
    assert body.damping_ratio == 0.01


def test_values_on_several_lines_are_not_replaced(held, capsys):
    folder, arguments = held
    path = folder / "vehicle.toml"
    path.write_text(path.read_text().replace("damping_ratio = 0.01", "damping_ratio = [\n0.02, 0.03]"))
    text = refused(capsys, *arguments, "--attach", "11", "--replace")
    assert "damping_ratio: to be replaced it has to be on one line" in text


def test_a_vehicle_that_cannot_be_read_is_left_as_it_was(tmp_path, file, capsys):
    folder = tmp_path / "vehicle"
    folder.mkdir()
    (folder / "vehicle.toml").write_text('name = "x"\nwrong = 1\n')
    arguments = [file(network_unv()), "--output", str(folder), "--units", "mm-t-s"]
    text = refused(capsys, *arguments)
    assert f"{folder}/vehicle.toml: wrong: unknown key" in text
    assert [path.name for path in folder.iterdir()] == ["vehicle.toml"]


def test_a_folder_of_something_else_is_left_alone(tmp_path, file, capsys):
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / "a.png").write_text("")
    text = refused(capsys, file(network_unv()), "--output", tmp_path / "photos", "--units", "mm-t-s")
    assert "is no vehicle folder" in text


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (network_unv(np.zeros(24)), "the modal mass of 24 of its 24 modes is not in the file"),
        (network_unv(first=6), "0 of its modes are near zero Hz"),
        (network_unv(first=2), "4 of its modes are near zero Hz"),
        (nodes_2411(LABELS, CORNERS), "it has no modes"),
        (network_unv(np.full(24, 1e-30)), "the modal mass of 24 of its 24 modes"),
        (network_op2(Op2(), unstable=20), "1 of its modes are unstable"),
        (shape_55([1], np.ones((1, 3)), 0.0), "none of the nodes that it moves has a place"),
        (
            nodes_2411([1], CORNERS[:1]) + shape_2414([1], np.ones((1, 3)) * 1j, 0.0, eigenvalue=1j),
            "its shapes are complex",
        ),
    ],
)
def test_what_cannot_be_coupled_is_listed_and_not_written(tmp_path, file, capsys, text, words):
    path = file(text, "block.op2" if isinstance(text, bytes) else "block.unv")
    assert main(["import", path]) == 0
    assert f"It cannot be coupled to others: {words}" in capsys.readouterr().out
    said = refused(capsys, path, "--output", tmp_path / "vehicle", "--units", "mm-t-s")
    assert f"cannot be coupled to others: {words}" in said
    assert not (tmp_path / "vehicle").exists()


def test_all_that_keeps_a_body_from_being_coupled_is_said_at_once(tmp_path, file, capsys):
    held = file(network_unv(np.zeros(24), first=6), "held.unv")
    without_units = refused(capsys, held, "--output", tmp_path / "vehicle")
    with_units = refused(capsys, held, "--output", tmp_path / "vehicle", "--units", "mm-t-s")
    for said in (without_units, with_units):
        assert "the modal mass of 18 of its 18 modes is not in the file" in said
        assert "; and 0 of its modes are near zero Hz" in said
    assert "doesn't say its units" in without_units
    assert "doesn't say its units" not in with_units


@pytest.mark.shared
def test_a_test_systems_modes_are_listed_with_what_is_unknown(capsys):
    assert main(["import", str(SHARED / "uff55_translation.uff")]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()[5:]]
    assert rows == [[str(n), f, "unknown", "unknown"] for n, f in enumerate(["10", "12", "13"], 1)]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--attach", "99"], "--attach: attachment '99': there is no node 99"),
        (["--attach", "x"], "--attach: found 'x', expected a node's number"),
        (["--attach", "a=1,2"], "--attach: found 'a=1,2', expected a node's number"),
        (["--attach", "a=nan,2,3"], "--attach: found 'a=nan,2,3'"),
        (["--attach", "1,2,3"], "--attach: found '1,2,3'"),
        (["--attach", "11", "--attach", "11=12"], "--attach: attachment '11': two have that name"),
    ],
)
def test_wrong_attachments_are_refused(tmp_path, file, capsys, arguments, words):
    folder = tmp_path / "vehicle"
    common = [file(network_unv()), "--output", folder, "--units", "mm-t-s"]
    assert words in refused(capsys, *common, *arguments)
    assert not folder.exists()


def test_options_of_a_body_that_is_not_written_are_refused(file, capsys):
    assert "say where with --output" in refused(capsys, file(network_unv()), "--attach", "11")


def test_files_of_no_known_format_are_refused(tmp_path, capsys):
    (tmp_path / "a.doc").write_text("")
    text = refused(capsys, tmp_path / "a.doc")
    assert "found '.doc', expected one of" in text
    named = re.findall(r"\.\w+", text.split("expected one of ")[1])
    assert len(named) == len(set(named))
    assert {".op2", ".pch", ".mtx", ".rst", ".unv", ".csv", ".xlsx", ".crg", ".bus", ".gbs"} <= {*named}
    assert "there is no such file" in refused(capsys, tmp_path / "b.unv")


def test_one_file_is_not_read_twice(tmp_path, file, capsys):
    path = Path(file(network_unv()))
    assert "block.unv: found twice" in refused(capsys, path, path.parent / "." / path.name)


def test_a_folder_in_place_of_files_is_told(tmp_path, capsys):
    (tmp_path / "pick up").mkdir()
    assert "pick up: is a folder, expected files" in refused(capsys, tmp_path / "pick up")
    with pytest.raises(VehicleError, match="pick up: is a folder, expected the files of a component"):
        import_component(tmp_path / "pick up")


def test_the_input_file_is_asked_for_where_it_may_say_what_modal_masses_are(tmp_path, file, capsys):
    """Of results without LAMA it says whether they are normalised to mass."""
    op2 = file(network_op2(Op2(), masses=np.zeros(24)), "run.op2")
    grids = "".join(
        f"GRID,{label},,{x:.1f},{y:.1f},{z:.1f}\n"
        for label, (x, y, z) in zip(LABELS, CORNERS, strict=True)
    )
    deck = file(f"BEGIN BULK\n{grids}ENDDATA\n", "run.bdf")
    words = "nobody knows what force moves them"
    main(["import", op2])
    assert f"{words}: give the input file too" in capsys.readouterr().out
    main(["import", op2, deck])
    assert f"{words}." in capsys.readouterr().out
    main(["import", file(network_unv(np.zeros(24)))])
    assert f"{words}." in capsys.readouterr().out


def test_an_imported_solid_is_drawn_by_its_outer_faces_and_moves_with_its_nodes(tmp_path, file):
    folder = tmp_path / "vehicle"
    main(["import", file(network_unv()), "--output", str(folder), "--units", "mm-t-s"])
    (body,) = read_vehicle(folder).bodies
    (surface,) = body.mesh
    assert len(surface.faces) == 12
    assert len(surface.vertices) == len(body.nodes) == 8
    turning = body.shapes[:, 3:, : body.n_rigid]
    np.testing.assert_allclose(turning - turning[:1], 0, atol=1e-6 * np.abs(turning).max())
    assert np.abs(turning).max() > 0


def test_rotations_of_the_file_are_radians_whatever_its_unit_of_length(tmp_path, file):
    """Those of the rigid modes, which follow from their translations, are the rigid motion's."""
    network = free_network()
    turns = np.cross(np.eye(3), CORNERS[:, None])  # θ × r about each axis, of each mass
    G = np.concatenate([np.tile(np.eye(3), (8, 1, 1)), turns.transpose(0, 2, 1)], axis=2)
    text = nodes_2411(LABELS, CORNERS)
    for mode in range(24):
        shape = np.zeros((8, 6))
        shape[:, :3] = network.shapes[:, :, mode]
        if mode < 6:
            shape[:, 3:] = np.linalg.lstsq(G.reshape(24, 6), shape[:, :3].ravel(), rcond=None)[0][3:]
        text += shape_55(LABELS, shape, network.frequency_hz[mode], mode=mode + 1)
    folder = tmp_path / "vehicle"
    main(["import", file(text), "--output", str(folder), "--units", "mm-t-s", "--attach", "24"])
    vehicle = read_vehicle(folder)
    (body,) = vehicle.bodies
    (attachment,) = body.attachments
    (expected,) = body.rigid_fit.moved(attachment.position[None])
    np.testing.assert_allclose(attachment.shapes[:, :6], expected, rtol=1e-3, atol=1e-4)
    assert np.abs(expected[3:]).max() > 0.01


def test_damping_ratios_of_the_file_are_the_bodys(tmp_path, file):
    network = free_network()
    text = nodes_2411(LABELS, CORNERS)
    for mode in range(10):
        damping = 0.001 * (mode + 1)
        text += shape_55(LABELS, network.shapes[:, :, mode], network.frequency_hz[mode], 1.0, damping)
    folder = tmp_path / "vehicle"
    main(["import", file(text), "--output", str(folder), "--units", "mm-t-s"])
    body = read_vehicle(folder).bodies[0]
    assert body.damping_ratio == pytest.approx((0.007, 0.008, 0.009, 0.010))
