"""Mass and stiffness matrices of other programs, with the nodes that they move."""

import io
import zipfile

import numpy as np
import pytest
import scipy.io
import scipy.linalg
import scipy.sparse as sp
from free_network import CORNERS, LABELS, free_network
from matrix_files import ribbed_panel, write_table

from modeviz.errors import VehicleError
from modeviz.formats.reading import read_component
from modeviz.formats.solving import Wanted, solved

NETWORK = free_network()
M, K = NETWORK.mass, NETWORK.stiffness


def table(path, labels=LABELS, places=CORNERS, header="node,x,y,z", end=""):
    rows = [f"{n},{x},{y},{z}{end}" for n, (x, y, z) in zip(labels, places, strict=True)]
    path.write_text("\n".join([*([header] if header else []), *rows]))
    return path


@pytest.fixture
def read(tmp_path):
    """Reads matrices as numpy.savez writes them, with a table of their nodes."""

    def read(mass=M, stiffness=K, nodes=None, **more):
        np.savez(tmp_path / "block.npz", M=mass, K=stiffness, **more)
        nodes = nodes or table(tmp_path / "nodes.csv")
        return read_component([tmp_path / "block.npz", nodes])

    return read


def elastic_hz(component):
    return component.modes.frequency_hz[6:]


EXACT = np.sqrt(scipy.linalg.eigh(K, M, eigvals_only=True)[6:]) / (2 * np.pi)


def test_modes_are_those_of_the_matrices(read):
    component = solved(read(), Wanted(n_modes=23))
    np.testing.assert_allclose(elastic_hz(component), EXACT[:17], rtol=1e-9)
    assert component.modes.frequency_hz[:6].tolist() == [0] * 6
    phi = component.modes.shapes[:, :3].reshape(24, 23)
    np.testing.assert_allclose(phi.T @ M @ phi, np.eye(23), atol=1e-9)


def test_modes_up_to_a_frequency(read):
    component = solved(read(), Wanted(up_to_hz=(EXACT[4] + EXACT[5]) / 2))
    np.testing.assert_allclose(elastic_hz(component), EXACT[:6], rtol=1e-9)


@pytest.mark.parametrize("form", ["csc", "csr", "coo", "bsr", "dia"])
@pytest.mark.parametrize("half", [sp.coo_array, sp.tril, sp.triu])
def test_what_scipy_saves_is_read_whole_or_as_a_triangle(tmp_path, form, half):
    paths = [table(tmp_path / "nodes.csv")]
    for name, A in (("K", K), ("M", M)):
        paths.append(tmp_path / f"block_{name}.npz")
        sp.save_npz(paths[-1], sp.coo_array(half(A)).asformat(form))
    component = read_component(paths)
    np.testing.assert_allclose(component.matrices.stiffness.toarray(), K, rtol=1e-14)
    np.testing.assert_allclose(component.matrices.mass.toarray(), M, rtol=1e-14)


@pytest.mark.parametrize("symmetry", ["general", "symmetric"])
@pytest.mark.parametrize("form", [sp.coo_array, np.asarray])
def test_what_scipy_writes_in_matrix_market_is_read(tmp_path, form, symmetry):
    paths = [table(tmp_path / "nodes.csv")]
    for name, A in (("K", K), ("M", M)):
        paths.append(tmp_path / f"block_{name}.mtx")
        scipy.io.mmwrite(paths[-1], form(A), symmetry=symmetry, precision=17)
    component = read_component(paths)
    np.testing.assert_allclose(component.matrices.stiffness.toarray(), K, rtol=1e-14)
    np.testing.assert_allclose(component.matrices.mass.toarray(), M, rtol=1e-14)


@pytest.mark.parametrize(
    "names",
    [
        ("K", "M"), ("stiffness", "mass"), ("KGG", "MGG"), ("kaax", "maax"), ("K2GG", "M2GG"),
        ("model_K", "model_M"), ("Job-1_STIF2", "Job-1_MASS2"), ("STIFFNESS_MATRIX", "MASS_MATRIX"),
    ],
)  # fmt: skip
def test_names_tell_stiffness_from_mass(tmp_path, names):
    np.savez(tmp_path / "block.npz", **dict(zip(names, (K, M), strict=True)))
    component = read_component([tmp_path / "block.npz", table(tmp_path / "nodes.csv")])
    np.testing.assert_allclose(component.matrices.stiffness.toarray(), K)


def test_arrays_may_have_their_bytes_in_the_other_order(read):
    component = read(M.astype(">f8"), K.astype(">f8"))
    np.testing.assert_allclose(component.matrices.stiffness.toarray(), K, rtol=1e-14)


def test_other_matrices_are_left_out_and_told(read):
    component = read(C=0.1 * K)
    assert "the matrices C are left out: neither mass nor stiffness" in component.notes


@pytest.mark.parametrize(
    ("header", "end", "change"),
    [
        ("node,x,y,z", "", None),
        ("", "", None),
        ("Node;X [mm];Y [mm];Z [mm]", "", (",", ";")),
        ("id\tx\ty\tz", "", (",", "\t")),
        ("id x y z", "", (",", " ")),
        ("node,x,y,z,dofs", ",123", None),
        ("", ",123", None),
        ('"node","x","y","z"', ",", None),
    ],
)
def test_tables_of_nodes_are_written_in_many_ways(tmp_path, read, header, end, change):
    path = table(tmp_path / "nodes.csv", header=header, end=end)
    if change:
        path.write_text(path.read_text().replace(*change))
    np.testing.assert_allclose(read(nodes=path).nodes, CORNERS)


def test_decimal_commas_stand_beside_semicolons(tmp_path, read):
    path = table(tmp_path / "nodes.csv", places=CORNERS + 0.5)
    path.write_text(path.read_text().replace(",", ";").replace(".", ","))
    np.testing.assert_allclose(read(nodes=path).nodes, CORNERS + 0.5)


def test_rows_stand_in_the_order_of_the_table(tmp_path, read):
    order = np.array([3, 0, 7, 2, 1, 6, 4, 5])
    dofs = (3 * order[:, None] + np.arange(3)).ravel()
    nodes = table(tmp_path / "nodes.csv", LABELS[order], CORNERS[order])
    component = read(M[dofs][:, dofs], K[dofs][:, dofs], nodes)
    assert component.node_ids.tolist() == LABELS.tolist()
    np.testing.assert_allclose(component.nodes, CORNERS)
    np.testing.assert_allclose(elastic_hz(solved(component, Wanted(n_modes=12))), EXACT[:6], rtol=1e-9)


def test_directions_of_nodes_differ_where_the_table_says_so(tmp_path, read):
    """A scalar too: a mass on a spring that its node's x pulls."""
    size = 25
    mass, stiffness = np.zeros((2, size, size))
    mass[:24, :24], stiffness[:24, :24] = M, K
    mass[24, 24], mass[24, 0], mass[0, 24] = 1e-4, 2e-5, 2e-5
    stiffness[24, 24] = 40.0
    path = table(tmp_path / "nodes.csv", header="node,x,y,z,dofs", end=",123")
    path.write_text(path.read_text() + "\n9000,0,0,0,0")
    component = read(mass, stiffness, path)
    exact = np.sqrt(scipy.linalg.eigh(stiffness, mass, eigvals_only=True)[6:]) / (2 * np.pi)
    found = solved(component, Wanted(n_modes=15))
    np.testing.assert_allclose(elastic_hz(found), exact[:9], rtol=1e-9)
    assert component.node_ids.tolist() == LABELS.tolist()


def test_degrees_of_freedom_with_neither_mass_nor_stiffness_are_left_out_and_told(tmp_path, read):
    """As of rotations of solids in a file with six directions for each node."""
    dofs = (6 * np.arange(8)[:, None] + np.arange(3)).ravel()
    mass, stiffness = np.zeros((2, 48, 48))
    mass[np.ix_(dofs, dofs)], stiffness[np.ix_(dofs, dofs)] = M, K
    component = read(mass, stiffness)
    assert component.matrices.n_dofs == 24
    assert "24 degrees of freedom have neither mass nor stiffness and are left out" in component.notes
    np.testing.assert_allclose(elastic_hz(solved(component, Wanted(n_modes=12))), EXACT[:6], rtol=1e-9)


def test_directions_without_mass_have_no_modes_of_their_own(tmp_path):
    """As of rotations under lumped masses: condensed exactly, by the dense solution."""
    panel = ribbed_panel()
    mass, stiffness, _ = panel.in_mm_t_s()
    lumped = sp.diags_array(np.where(np.arange(mass.shape[0]) % 6 < 3, 2e-4, 0.0))
    sp.save_npz(tmp_path / "K.npz", stiffness)
    sp.save_npz(tmp_path / "M.npz", sp.csc_array(lumped))
    nodes = write_table(tmp_path / "nodes.csv", panel)
    component = read_component([tmp_path / "K.npz", tmp_path / "M.npz", nodes])
    moves = np.flatnonzero(lumped.diagonal())
    turns = np.setdiff1d(np.arange(mass.shape[0]), moves)
    dense = stiffness.toarray()
    condensed = dense[np.ix_(moves, moves)] - dense[np.ix_(moves, turns)] @ np.linalg.solve(
        dense[np.ix_(turns, turns)], dense[np.ix_(turns, moves)]
    )
    omega_squared = scipy.linalg.eigh(condensed, lumped.toarray()[np.ix_(moves, moves)])[0]
    for n_modes in (20, 200):
        found = elastic_hz(solved(component, Wanted(n_modes=n_modes)))[:14]
        np.testing.assert_allclose(found, np.sqrt(omega_squared[6:20]) / (2 * np.pi), rtol=1e-7)


def test_a_stiffness_without_the_last_digits_is_free_all_the_same(read):
    """As of files with seven digits: rigid motion strains it by their rounding."""
    rounded = np.vectorize(lambda value: float(f"{value:.6e}"))(K)
    component = solved(read(stiffness=rounded), Wanted(n_modes=12))
    np.testing.assert_allclose(elastic_hz(component), EXACT[:6], rtol=1e-6)


def changed(A, row, column, value):
    A = A.copy()
    A[row, column] = value
    return A


def without(A, dofs):
    kept = np.setdiff1d(np.arange(len(A)), dofs)
    return A[np.ix_(kept, kept)]


def in_two(A):
    return scipy.linalg.block_diag(A, A)


@pytest.mark.parametrize(
    ("mass", "stiffness", "words"),
    [
        (M, K + 50 * np.eye(24), "is held: moving as a whole"),
        (M, changed(K, 3, 5, 1.0), "is not symmetric: found .* 1 "),
        (M, changed(K, 3, 3, np.nan), "not finite numbers"),
        (M, changed(K, 3, 3, 1e172), r"beyond 1e\+30"),
        (M[:21, :21], K, "21 rows, matrix K 24"),
        (without(M, [2]), without(K, [2]), "neither three nor six for each of the 8 nodes"),
        (-M, K, "expected no negative mass"),
        (0 * M, K, "no mass on its diagonal"),
        (np.diag(np.tile([1.0, 1.0, 0.0], 8)), K, "mass along z is 0"),
        (np.diag(np.tile([1.0, 1.0, 0.5], 8)), K, "expected the same"),
        (M, -K, "negative|without strain"),
        (K, M, "negative mass|expected the same|mass along"),
    ],
)
def test_what_is_no_free_structure_is_refused_in_a_sentence(read, mass, stiffness, words):
    with pytest.raises(VehicleError, match=words):
        solved(read(mass, stiffness), Wanted())


def test_parts_that_nothing_joins_are_refused_with_a_node_of_the_smaller(tmp_path, read):
    labels = [*LABELS, *(100 + LABELS)]
    nodes = table(tmp_path / "nodes.csv", labels, np.vstack([CORNERS, CORNERS + 5]))
    with pytest.raises(VehicleError, match=r"2 parts that nothing joins.* 8 of 16 nodes, such as 11"):
        read(in_two(M), in_two(K), nodes)


def test_matrices_without_nodes_are_refused(tmp_path):
    np.savez(tmp_path / "block.npz", K=K, M=M)
    with pytest.raises(VehicleError, match="give a table of nodes"):
        read_component([tmp_path / "block.npz"])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "no nodes"),
        ("node,x,y,z", "no nodes"),
        ("node,x,y\n1,2,3", "without z"),
        ("node,x,y,z\n1,2,3,4\n1.5,2,3,4", "expected whole numbers"),
        ("node,x,y,z\n1,2,3,4\n2,2,3", "is no table of numbers"),
        ("node,x,y,z\n1,2,3,four", "is no table of numbers"),
        ("node,x,y,z\n1,2,3,nan", "not finite"),
        ("node,x,y,z,dofs\n1,2,3,4,127", "found the dofs 127"),
        ("node,x,y,z,dofs\n1,2,3,4,113", "found the dofs 113"),
        ("node,x,y,z\n" + "11,0,0,0\n" * 8, "twice"),
        ("node,x,y,z,node\n1,2,3,4,5", "twice"),
    ],
)
def test_tables_that_are_none_are_refused_in_a_sentence(tmp_path, read, text, words):
    path = tmp_path / "nodes.csv"
    path.write_text(text)
    with pytest.raises(VehicleError, match=words):
        read(nodes=path)


def huge_header(shape=(10**6, 10**6)):
    content = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        content, {"descr": "<f8", "fortran_order": False, "shape": shape}
    )
    return content.getvalue()


def npz(members):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    return content.getvalue()


def saved(**arrays):
    content = io.BytesIO()
    np.savez(content, **arrays)
    return content.getvalue()


def parts(**changed):
    A = sp.csc_array(K)
    whole = {"format": np.array(b"csc"), "shape": np.array(A.shape), "data": A.data}
    return saved(**(whole | {"indices": A.indices, "indptr": A.indptr} | changed))


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "not a whole .npz file"),
        (saved(K=K, M=M)[:300], "not a whole .npz file"),
        (saved(K=np.array([[{}]]), M=M), "not a whole .npz file"),
        (npz({"K.npy": huge_header(), "M.npy": huge_header()}), "not a whole .npz file"),
        (npz({"K.npy": bytes(70_000_000)}), "not a whole .npz file"),
        (saved(K=K), "no mass matrix among"),
        (saved(K=K, M=M, stiffness=K), "2 stiffness matrices"),
        (saved(K=K.astype(complex), M=M), "no stiffness matrix"),
        (parts(indices=sp.csc_array(K).indices + 100), "make no matrix"),
        (parts(indptr=sp.csc_array(K).indptr[:-3]), "make no matrix"),
        (parts(shape=np.array([10**12, 10**12])), "degrees of freedom in a matrix"),
        (parts(shape=np.array([-4, 5])), "expected two whole numbers"),
        (parts(format=np.array(b"lil")), "format 'lil'"),
    ],
)
def test_damaged_archives_are_refused_in_a_sentence(tmp_path, content, words):
    path = tmp_path / "K.npz"
    path.write_bytes(content)
    with pytest.raises(VehicleError, match=words):
        read_component([path, table(tmp_path / "nodes.csv")])


def test_an_archive_that_unpacks_to_far_more_is_not_unpacked(tmp_path, monkeypatch):
    monkeypatch.setattr("modeviz.formats.matrices.arrays.LEAST_BYTES", 1_000_000)
    path = tmp_path / "K.npz"
    path.write_bytes(npz({"K.npy": bytes(50_000_000)}))
    with pytest.raises(VehicleError, match="unpacks to 50,000,000 bytes, more than arrays in"):
        read_component([path, table(tmp_path / "nodes.csv")])


HEAD = "%%MatrixMarket matrix coordinate real symmetric\n"
GENERAL = HEAD.replace("symmetric", "general")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "neither Matrix Market's nor Abaqus's"),
        ("%%MatrixMarket\n", "expected that of a matrix"),
        (HEAD, "expected 3 whole numbers of its size"),
        (HEAD + "3 3\n", "expected 3 whole numbers of its size"),
        (HEAD + "3 3 -2\n", "expected 3 whole numbers of its size"),
        (HEAD + "3 3 2\n1 1 4.0\n", "found 1 lines of 3 numbers, expected 2"),
        (HEAD + "3 3 1\n1 1 4.0\n2 2 4.0\n", "found more lines"),
        (HEAD + "3 3 1\n1 4 4.0\n", "an entry in column 4, expected 1 to 3"),
        (HEAD + "3 3 1\n1 1 four\n", "no table of numbers"),
        (HEAD + "3 3 1\n1 1.5 4.0\n", "no whole numbers"),
        (HEAD + "3 3 1\n1 1e300 4.0\n", "an entry in column"),
        (HEAD + "3 3 1\n1 1\n", "found 1 lines of 2 numbers, expected 1 of 3"),
        (HEAD + "24 24 1\n1 1 nan\n", "not finite numbers"),
        (GENERAL + "24 23 1\n1 1 4.0\n", "found 24 rows and 23 columns"),
        (HEAD + "24 24 900000000000\n1 1 4.0\n", "entries in a matrix"),
        (HEAD + "24 24 90000000\n1 1 4.0\n", "found 1 lines"),
        (HEAD + "99000000 99000000 1\n1 1 4.0\n", "degrees of freedom in a matrix"),
        (HEAD.replace("coordinate", "array") + "9000000 9000000\n1.0\n", "entries in a matrix"),
        (HEAD.replace("coordinate", "array") + "24 23\n1.0\n", "of a symmetric matrix"),
        (HEAD.replace("real", "complex") + "24 24 1\n1 1 4.0 1.0\n", "of complex numbers"),
        (HEAD.replace("symmetric", "hermitian") + "24 24 1\n1 1 4.0\n", "found a hermitian matrix"),
    ],
)
def test_damaged_matrix_market_files_are_refused_in_a_sentence(tmp_path, text, words):
    paths = [tmp_path / "K.mtx", tmp_path / "M.mtx"]
    paths[0].write_text(text)
    scipy.io.mmwrite(paths[1], sp.coo_array(M))
    with pytest.raises(VehicleError, match=words):
        read_component([*paths, table(tmp_path / "nodes.csv")])
