import sys

import h5py
import numpy as np
import pytest
from free_network import CORNERS, HEXA, LABELS, free_network
from hdf5_files import BUCKLING, COMPLEX_MODES, Hdf5, network_hdf5

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.formats.nastran import read_nastran

SQUARE = [(1, 0, (0, 0, 0), 0), (2, 0, (1, 0, 0), 0), (3, 0, (1, 1, 0), 0), (4, 0, (0, 1, 0), 0)]
IDS = [1, 2, 3, 4]
EIGENVECTOR = "NASTRAN/RESULT/NODAL/EIGENVECTOR"


@pytest.fixture
def read(tmp_path):
    return lambda hdf5: read_nastran([hdf5.write(tmp_path / "a.h5")])


def square() -> Hdf5:
    return Hdf5().grids(SQUARE).mode(IDS, np.ones((4, 6)), 1, 400.0).eigenvalues([(1, 400.0, 2.5)])


def test_modes_and_geometry_are_read_to_the_last_digit(read):
    network = free_network()
    component = read(network_hdf5())
    np.testing.assert_array_equal(component.node_ids, LABELS)
    np.testing.assert_array_equal(component.nodes, CORNERS)
    np.testing.assert_array_equal(component.modes.shapes[:, :3], network.shapes)
    np.testing.assert_allclose(component.modes.frequency_hz, network.frequency_hz, rtol=1e-14)
    np.testing.assert_array_equal(component.modes.modal_mass, 1)
    assert component.node_ids[component.elements["hexa"]].tolist() == [list(HEXA)]
    assert component.notes == ()


def test_modes_that_are_not_among_those_before_residual_vectors_were_added_are_such(read):
    hdf5 = square().mode(IDS, np.ones((4, 6)), 2, 900.0)
    hdf5.eigenvalues([(1, 400.0, 2.5, 1), (1, 400.0, 2.5, 2), (2, 900.0, 1.5, 2)])
    modes = read(hdf5).modes
    assert modes.n_residuals == 1
    assert modes.modal_mass.tolist() == [2.5, 1.5]


def test_a_body_is_made_of_an_hdf5_file(tmp_path, capsys):
    path, folder = network_hdf5().write(tmp_path / "a.h5"), tmp_path / "vehicle"
    arguments = ["import", str(path), "--output", str(folder), "--units", "mm-t-s", "--attach", "11"]
    assert main(arguments) == 0
    assert "6 rigid and 18 elastic modes" in capsys.readouterr().out


def test_motions_are_turned_out_of_the_systems_of_their_grids(read):
    """By hand: at (0, 2, 0) r is y and θ is -x; at (0, 0, 2) θ of the sphere is x, φ is y."""
    points = np.array([[0, 0, 0], [0, 0, 1], [1, 0, 0]])
    grids = [(1, 0, (0, 2, 0), 10), (2, 0, (0, 0, 2), 20), (3, 10, (2, 90, 5), 0)]
    hdf5 = Hdf5().grids(grids).frame("C", 10, points).frame("S", 20, points)
    hdf5.mode([1, 2, 3], np.tile([1.0, 2, 3, 4, 5, 6], (3, 1)), 1, 400.0)
    component = read(hdf5)
    np.testing.assert_allclose(
        component.modes.shapes[:, :, 0],
        [[-2, 1, 3, -5, 4, 6], [2, 3, 1, 5, 6, 4], [1, 2, 3, 4, 5, 6]],
        atol=1e-12,
    )
    np.testing.assert_allclose(component.nodes[2], [0, 2, 5], atol=1e-12)


def test_systems_given_by_grids(read):
    hdf5 = Hdf5().grids([*SQUARE, (5, 7, (0, 0, 2), 0)])
    hdf5.input("COORDINATE_SYSTEM/CORD1R", [(7, 1, 2, 4)], "CORD1")
    component = read(hdf5)  # its z goes from grid 1 to 2, its x to 4
    np.testing.assert_allclose(component.nodes[4], [2, 0, 0], atol=1e-12)


def test_corners_of_elements_in_columns_of_every_name(read):
    hdf5 = square().input("ELEMENT/CBAR", [(1, 1, 1, 2, 0), (2, 1, 2, 0, 0)])
    hdf5.input("ELEMENT/CONROD", [(3, 2, 3, 1, 1.0)])
    hdf5.input("ELEMENT/CTRIA6", [(4, 1, [1, 3, 4, 0, 0, 0], 0.0)])
    elements = read(hdf5).elements
    assert {kind: rows.tolist() for kind, rows in elements.items()} == {
        "line": [[1, 2], [0, 1]],
        "triangle": [[0, 2, 3]],
    }


def test_scalar_points_other_subcases_and_modes_that_buckle_are_not_shown(read):
    hdf5 = square().input("NODE/SPOINT", [(99,)])
    hdf5.mode(IDS, np.ones((4, 6)), 1, -9.0, analysis=BUCKLING)
    hdf5.mode(IDS, np.ones((4, 6)), 1, 900.0, subcase=2)
    hdf5.mode([*IDS, 99], np.full((5, 6), 2.0), 2, 500.0)
    component = read(hdf5)
    np.testing.assert_allclose(component.modes.frequency_hz, np.sqrt([400, 500]) / (2 * np.pi))
    assert component.modes.shapes[0, 0].tolist() == [1, 2]
    assert component.notes == ("1 modes of other subcases than 1 are left out",)


def test_superelements_with_a_subcase_each_are_one_component(read):
    """Grids 2 and 3 are in both, as on their boundary; the residual structure comes first."""
    hdf5 = Hdf5().grids([*SQUARE, *SQUARE[1:3]]).mode([2, 3], np.full((2, 6), 5.0), 1, 400.0, subcase=3)
    hdf5.mode([1, 2], np.full((2, 6), 5.0), 1, 400.0).mode(
        [3, 4], np.full((2, 6), 5.0), 1, 400.0, subcase=2
    )
    component = read(hdf5)
    assert component.node_ids.tolist() == IDS
    np.testing.assert_array_equal(component.modes.shapes, 5)
    assert component.notes == ()


def test_complex_modes_have_damping_and_no_modal_mass(read):
    motions = np.full((4, 6), 1 + 2j)
    component = read(Hdf5().grids(SQUARE).mode(IDS, motions, 1, -3 + 4j, analysis=COMPLEX_MODES))
    np.testing.assert_allclose(component.modes.damping_ratio, 3 / 5)
    np.testing.assert_allclose(component.modes.frequency_hz, 5 / (2 * np.pi))
    np.testing.assert_array_equal(component.modes.shapes[:, :, 0], motions)
    assert np.isnan(component.modes.modal_mass).all()


def test_a_factor_of_masses_is_told(read):
    hdf5 = square().input("PARAMETER/PVT/DOUBLE", [(b"WTMASS  ", 0.00259)])
    (note,) = read(hdf5).notes
    assert note.startswith("PARAM,WTMASS is 0.00259")


def test_the_input_file_may_have_the_geometry(tmp_path):
    hdf5 = Hdf5().mode(IDS, np.ones((4, 6)), 1, 400.0).write(tmp_path / "a.h5")
    assert any("give the input file too" in note for note in read_nastran([hdf5]).notes)
    deck = tmp_path / "a.bdf"
    deck.write_text("".join(f"GRID,{i},,{x}.,{y}.,{z}.\n" for i, _, (x, y, z), _ in SQUARE))
    component = read_nastran([hdf5, deck])
    np.testing.assert_array_equal(component.nodes, [place for _, _, place, _ in SQUARE])
    assert component.n_modes == 1


def without_h5py(path, monkeypatch):
    monkeypatch.setitem(sys.modules, "h5py", None)


def linked(path, _):
    with h5py.File(path.parent / "other.h5", "w") as other, h5py.File(path, "r+") as file:
        file.copy(EIGENVECTOR, other, "rows")
        del file[EIGENVECTOR]
        file[EIGENVECTOR] = h5py.ExternalLink("other.h5", "/rows")


def soft_linked(path, _):
    with h5py.File(path, "r+") as file:
        file.move("NASTRAN/RESULT/NODAL", "elsewhere")
        file["NASTRAN/RESULT/NODAL"] = h5py.SoftLink("/NASTRAN/RESULT")


def stored_outside(path, _):
    with h5py.File(path, "r+") as file:
        rows = file[EIGENVECTOR][:]
        del file[EIGENVECTOR]
        outside = [("/etc/hostname", 0, rows.nbytes)]
        file.create_dataset(EIGENVECTOR, rows.shape, rows.dtype, external=outside)


def virtual(path, _):
    with h5py.File(path, "r+") as file:
        kind = file[EIGENVECTOR].dtype
        del file[EIGENVECTOR]
        layout = h5py.VirtualLayout((4,), kind)
        layout[:] = h5py.VirtualSource("other.h5", "rows", (4,), kind)
        file.create_virtual_dataset(EIGENVECTOR, layout)


def bomb(path, _):
    """A table of 10¹² rows, in a file of a few kilobytes."""
    with h5py.File(path, "r+") as file:
        kind = file[EIGENVECTOR].dtype
        del file[EIGENVECTOR]
        file.create_dataset(EIGENVECTOR, (10**12,), kind, chunks=(1000,), compression="gzip")


def matrix(path, _):
    with h5py.File(path, "r+") as file:
        del file[EIGENVECTOR]
        file[EIGENVECTOR] = np.ones((4, 8))


def other_columns(path, _):
    with h5py.File(path, "r+") as file:
        del file[EIGENVECTOR]
        file[EIGENVECTOR] = np.array([(i, 0.0) for i in IDS], [("ID", "i8"), ("T1", "f8")])


def index_beyond(path, _):
    with h5py.File(path, "r+") as file:
        rows = file[f"INDEX/{EIGENVECTOR}"][:]
        rows["LENGTH"] = 5
        file[f"INDEX/{EIGENVECTOR}"][:] = rows


def no_index(path, _):
    with h5py.File(path, "r+") as file:
        del file["INDEX"]


def no_domains(path, _):
    with h5py.File(path, "r+") as file:
        del file["NASTRAN/RESULT/DOMAINS"]


def not_numbers(path, _):
    with h5py.File(path, "r+") as file:
        rows = file[EIGENVECTOR][:]
        rows["Z"] = np.nan
        file[EIGENVECTOR][:] = rows


def text_for_numbers(path, _):
    with h5py.File(path, "r+") as file:
        del file[EIGENVECTOR]
        names = ["ID", "X", "Y", "Z", "RX", "RY", "RZ", "DOMAIN_ID"]
        file[EIGENVECTOR] = np.zeros(4, [(name, "S8") for name in names])


def of_another_program(path, _):
    with h5py.File(path, "w") as file:
        file["results/modes"] = np.ones(3)


def cut(path, _):
    path.write_bytes(path.read_bytes()[:-3000])


def line_ends(path, _):
    path.write_bytes(path.read_bytes().replace(b"\r\n", b"\n"))


def signature(name: bytes, count: int = -1):
    """A signature inside is another: found by damaging files at random."""

    def damage(path, _):
        content = path.read_bytes()
        assert name in content
        path.write_bytes(content.replace(name, name[::-1], count))

    return damage


def empty(path, _):
    path.write_bytes(b"")


def a_universal_file(path, _):
    path.write_text("    -1\n   151\n    -1\n")


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (without_h5py, "pip install 'modeviz[hdf5]'"),
        (linked, "is a link to elsewhere"),
        (soft_linked, "is a link to elsewhere"),
        (stored_outside, "is in another file"),
        (virtual, "is in another file"),
        (bomb, "more than a file of"),
        (matrix, "expected rows of named columns"),
        (other_columns, "has no column X, Y, Z"),
        (index_beyond, "has 4 rows, and INDEX says"),
        (no_index, "has no table INDEX/NASTRAN"),
        (no_domains, "has no table NASTRAN/RESULT/DOMAINS"),
        (not_numbers, "not finite numbers"),
        (text_for_numbers, "of another kind"),
        (of_another_program, "no file of results of MSC Nastran"),
        (cut, "is cut or damaged"),
        (line_ends, "is cut or damaged"),
        (signature(b"TREE"), "is cut or damaged"),
        (signature(b"SNOD"), "is cut or damaged"),
        (signature(b"HEAP"), "is cut or damaged"),
        (empty, "is cut or damaged"),
        (a_universal_file, "is cut or damaged"),
    ],
)
def test_damaged_hdf5_files_are_refused_in_a_sentence(tmp_path, monkeypatch, capsys, damage, words):
    path = square().write(tmp_path / "a.h5")
    damage(path, monkeypatch)
    with pytest.raises(VehicleError) as caught:
        read_nastran([path])
    assert words in str(caught.value)
    assert str(caught.value).startswith(str(path))
    folder = tmp_path / "vehicle"
    assert main(["import", str(path), "--output", str(folder), "--units", "mm-t-s"]) == 2
    assert not folder.exists()
