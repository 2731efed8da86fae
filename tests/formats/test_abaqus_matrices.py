"""Matrices as Abaqus and CalculiX write them, after the Keywords guide and files of theirs."""

import io

import numpy as np
import pytest
import scipy.io
import scipy.linalg
from damage import within_bounds
from free_network import CORNERS, LABELS, free_network

from modeviz.errors import VehicleError
from modeviz.formats.reading import read_component
from modeviz.formats.solving import Wanted, solved

NETWORK = free_network()
M, K = NETWORK.mass, NETWORK.stiffness
EXACT = np.sqrt(scipy.linalg.eigh(K, M, eigvals_only=True)[6:]) / (2 * np.pi)


def triangle(A):
    """The lower triangle as Abaqus writes it: a row begins a line, which has four numbers."""
    lines = []
    for i in range(len(A)):
        row = [f"{value:20.13E}" for value in A[i, : i + 1]]
        for start in range(0, i + 1, 4):
            part = row[start : start + 4]
            lines.append(",".join(part) + ("," if len(part) < 4 or start + 4 < i + 1 else ""))
    return "\n".join(lines)


def whole(A):
    numbers = [f"{value:20.13E}" for value in A.ravel()]
    return "\n".join(",".join(numbers[i : i + 4]) + "," for i in range(0, len(numbers), 4))


def substructure(labels=LABELS, stiffness=K, mass=M, dofs="1, 2, 3", unsymmetric=False):
    """A file of *SUBSTRUCTURE MATRIX OUTPUT; the mass is a triangle in any case."""
    names = [f"{label:11d}" for label in labels]
    comments = "\n".join("**" + ",".join(names[i : i + 10]) for i in range(0, len(names), 10))
    return "\n".join(
        [
            "**",
            "** GENERATION OF SUBSTRUCTURE Z1",
            f"*USER ELEMENT, NODES={len(labels):10d}, LINEAR{', UNSYM' if unsymmetric else ''}",
            "** ELEMENT NODES",
            comments.replace(",\n", ", \n"),
            dofs,
            "*MATRIX,TYPE=STIFFNESS",
            (whole if unsymmetric else triangle)(stiffness),
            "*MATRIX,TYPE=MASS",
            triangle(mass),
            "",
        ]
    )


@pytest.fixture
def read(tmp_path):
    """Reads files by their names, with a table of nodes as under *NODE, in another order."""

    def read(places=CORNERS, labels=LABELS, **files):
        rows = [f"{n}, {x}, {y}, {z}" for n, (x, y, z) in zip(labels, places, strict=True)]
        (tmp_path / "nodes.csv").write_text("\n".join(rows[::-1]))
        paths = [tmp_path / f"{name}.mtx" for name in files]
        for path, text in zip(paths, files.values(), strict=True):
            path.write_text(text)
        return read_component([*paths, tmp_path / "nodes.csv"])

    return read


@pytest.mark.parametrize("unsymmetric", [False, True])
def test_a_substructure_has_the_modes_of_its_matrices(read, unsymmetric):
    component = solved(read(Z1=substructure(unsymmetric=unsymmetric)), Wanted(n_modes=20))
    np.testing.assert_allclose(component.modes.frequency_hz[6:], EXACT[:14], rtol=1e-9)
    assert component.node_ids.tolist() == LABELS.tolist()


def market(A) -> str:
    """A file of Matrix Market, which says nothing of its rows."""
    content = io.BytesIO()
    scipy.io.mmwrite(content, A)
    return content.getvalue().decode()


TWICE = np.array([*LABELS[:7], LABELS[2]])


@pytest.mark.parametrize(
    "files",
    [
        {"Z1": substructure(TWICE)},
        {"Z1": substructure(TWICE).split("*MATRIX,TYPE=MASS")[0], "mass": market(M)},
        {"Z1": substructure(dofs="1, 2, 1")},
    ],
)
def test_a_direction_that_is_there_twice_in_a_matrix_is_refused(read, files):
    """Whether both matrices say of their rows what they are, or one."""
    with pytest.raises(VehicleError, match=r"node \d+, direction 1: is there twice in a matrix"):
        read(**files)


def test_a_substructure_may_name_its_nodes_in_any_order(read):
    order = np.array([3, 0, 7, 2, 1, 6, 4, 5])
    dofs = (3 * order[:, None] + np.arange(3)).ravel()
    text = substructure(LABELS[order], K[dofs][:, dofs], M[dofs][:, dofs])
    component = solved(read(Z1=text), Wanted(n_modes=20))
    np.testing.assert_allclose(component.modes.frequency_hz[6:], EXACT[:14], rtol=1e-9)


def test_directions_change_at_places_in_the_list_of_nodes(read):
    """The third node has x alone, and then all have three again: y and z of it are held in K and M."""
    kept = np.delete(np.arange(24), [7, 8])
    text = substructure(
        stiffness=K[kept][:, kept], mass=M[kept][:, kept], dofs="1, 2, 3\n3, 1\n4, 1, 2, 3"
    )
    with pytest.raises(VehicleError, match="the mass along x, y and z is"):
        read(Z1=text)


def test_calculix_names_a_node_for_each_of_its_directions(read):
    labels = np.repeat(LABELS, 3)
    directions = [f"{i:10d},{i % 3 or 3:10d}" for i in range(1, 25)]
    text = substructure(labels, dofs="\n".join([f"{1:10d}", *directions[1:]]))
    component = solved(read(Z1=text), Wanted(n_modes=20))
    np.testing.assert_allclose(component.modes.frequency_hz[6:], EXACT[:14], rtol=1e-9)


def entries(A, write, half=True):
    rows, columns = np.nonzero(np.tril(A) if half else A)
    return "\n".join(write(i, j, A[i, j]) for i, j in zip(rows, columns, strict=True)) + "\n"


def by_labels(i, j, value):
    return f"{LABELS[i // 3]},{i % 3 + 1}, {LABELS[j // 3]},{j % 3 + 1}, {value:.16e}"


def by_places(i, j, value):
    return f"{i + 1:12d} {j + 1:12d} {value:25.16e}"


@pytest.mark.parametrize("half", [True, False])
def test_matrices_of_a_model_name_their_nodes(read, half):
    component = read(
        job_STIF2=entries(K, by_labels, half), job_MASS2="** mass\n" + entries(M, by_labels, half)
    )
    np.testing.assert_allclose(component.matrices.stiffness.toarray(), K, rtol=1e-12)
    found = solved(component, Wanted(n_modes=20)).modes.frequency_hz
    np.testing.assert_allclose(found[6:], EXACT[:14], rtol=1e-9)


def test_directions_that_have_no_mass_are_missing_in_its_matrix(read):
    """A massless node tied to another by three springs moves with it."""
    tied = ["11,1, 99,1, -50.0", "11,2, 99,2, -50.0", "11,3, 99,3, -50.0"]
    more = [f"99,{d}, 99,{d}, 50.0" for d in (1, 2, 3)]
    ground = K.copy()
    ground[:3, :3] += 50.0 * np.eye(3)
    text = entries(ground, by_labels) + "\n".join([*tied, *more])
    component = read(
        np.vstack([CORNERS, CORNERS[0]]), [*LABELS, 99], STIF=text, MASS=entries(M, by_labels)
    )
    found = solved(component, Wanted(n_modes=20)).modes.frequency_hz
    np.testing.assert_allclose(found[6:], EXACT[:14], rtol=1e-9)


def test_coordinates_of_entries_count_the_rows_of_the_table(read, tmp_path):
    rows = [f"{n}, {x}, {y}, {z}" for n, (x, y, z) in zip(LABELS, CORNERS, strict=True)]
    read(K_STIF2=entries(K, by_places, False), M_MASS2=entries(M, by_places, False))
    (tmp_path / "nodes.csv").write_text("\n".join(rows))
    paths = [tmp_path / name for name in ("K_STIF2.mtx", "M_MASS2.mtx", "nodes.csv")]
    component = read_component(paths)
    np.testing.assert_allclose(component.matrices.stiffness.toarray(), K, rtol=1e-12)


GOOD = substructure()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (GOOD[: len(GOOD) // 2], "expected 300 of the lower triangle"),
        (GOOD.replace("NODES=         8", "NODES=         9"), "NODES=9 and 8 numbers"),
        (GOOD.replace("1, 2, 3", "1, 2, 9"), "directions other than 1 to 6"),
        (GOOD.replace("1, 2, 3", "1, 2, 3\n77, 1"), "nodes that are not there"),
        (GOOD.replace("1, 2, 3\n", ""), "no line with the directions"),
        (GOOD.replace("1, 2, 3", "1, 2, x"), "expected whole numbers"),
        (GOOD.replace("E+0", "X+0"), "found no numbers"),
        (GOOD[GOOD.index("*MATRIX") :], "stands before"),
        (GOOD + GOOD, "several elements"),
        ("", "neither Matrix Market's nor Abaqus's"),
        ("11,1,12,1\n", "found '11,1,12,1', expected node, direction, node, direction and value"),
        ("1,2,3,4\n" * 5_000_000, "found '1,2,3,4', expected node, direction"),
        ("1" * 20_000_000, "a line of more than 10,000 letters"),
        ("*A\n" * 1_000_000, "found 1,001 keywords, expected at most 1,000"),
        (GOOD[: GOOD.index("*MATRIX")] + "1,2,3\n" * 5_000_000, "100,001 lines with directions"),
        (GOOD.replace("*MATRIX,TYPE=MASS\n", "9.0,9.0\n" * 5_000_000), "expected 300 of the lower"),
        ("11,1,12,1,x\n", "neither Matrix Market's nor Abaqus's"),
        ("11,1,12.5,1,4.0\n", "no whole numbers"),
        ("-3,1,12,1,4.0\n", "node -3, an internal one"),
        ("11,1,11,7,4.0\n", "directions other than 1 to 6"),
        ("11,1,11,1,1e36\n", "node 11, direction 1: is held"),
        ("1 99000000 3.0\n", "degrees of freedom in a matrix"),
        ("0 1 3.0\n", "an entry in row 0, expected 1 to 1"),
    ],
)
def test_damaged_files_are_refused_in_a_sentence(read, text, words):
    """At once, however long they are."""
    with within_bounds(), pytest.raises(VehicleError, match=words):
        read(K=text, M=entries(M, by_labels))
