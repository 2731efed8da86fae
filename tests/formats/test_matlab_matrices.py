"""Matrices in MATLAB's files: of versions 4, 5 and 7 as SciPy writes them, of 7.3 as MATLAB does."""

import io
import struct

import h5py
import numpy as np
import pytest
import scipy.io
import scipy.sparse as sp
from free_network import CORNERS, LABELS, free_network

from modeviz.errors import VehicleError
from modeviz.formats.reading import read_component

NETWORK = free_network()
M, K = NETWORK.mass, NETWORK.stiffness


@pytest.fixture
def read(tmp_path):
    def read(content):
        (tmp_path / "block.mat").write_bytes(content)
        rows = [f"{n}, {x}, {y}, {z}" for n, (x, y, z) in zip(LABELS, CORNERS, strict=True)]
        (tmp_path / "nodes.csv").write_text("\n".join(rows))
        return read_component([tmp_path / "block.mat", tmp_path / "nodes.csv"])

    return read


def saved(arrays, **options):
    content = io.BytesIO()
    scipy.io.savemat(content, arrays, **options)
    return content.getvalue()


def saved_73(arrays, change=None):
    """As MATLAB writes -v7.3: a block of 512 bytes before the HDF5 file, full matrices by columns."""
    content = io.BytesIO()
    with h5py.File(content, "w", userblock_size=512) as file:
        for name, A in arrays.items():
            if not sp.issparse(A):
                dataset = file.create_dataset(name, data=np.asarray(A).T)
                dataset.attrs["MATLAB_class"] = np.bytes_("double")
                continue
            group = file.create_group(name)
            group.attrs["MATLAB_class"] = np.bytes_("double")
            group.attrs["MATLAB_sparse"] = np.uint64(A.shape[0])
            for part, values in (("data", A.data), ("ir", A.indices), ("jc", A.indptr)):
                kind = np.float64 if part == "data" else np.uint64
                group.create_dataset(part, data=values.astype(kind))
        if change:
            change(file)
    head = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Mon Jan  1 00:00:00 2024".ljust(512)
    return head + content.getvalue()[512:]


ARRAYS = {"K": K, "M": M, "name": "block", "C": np.zeros((0, 0)), "x": np.arange(3.0)}
SPARSE = {"K": sp.csc_array(K), "M": sp.csc_array(M)}


@pytest.mark.parametrize(
    "content",
    [
        saved(ARRAYS),
        saved(SPARSE),
        saved(ARRAYS, do_compression=True),
        saved(SPARSE, do_compression=True),
        saved({"K": K, "M": M}, format="4"),
        saved_73({"K": K, "M": M}),
        saved_73(SPARSE),
        saved_73({"K": sp.csc_array(np.triu(K)), "M": sp.csc_array(M), "L": sp.csc_array((24, 24))}),
    ],
)
def test_full_and_sparse_matrices_of_every_version(read, content):
    component = read(content)
    np.testing.assert_allclose(component.matrices.stiffness.toarray(), K, rtol=1e-14)
    np.testing.assert_allclose(component.matrices.mass.toarray(), M, rtol=1e-14)


def linked(file):
    file["K2"] = h5py.ExternalLink("other.mat", "K")


def test_links_to_other_files_are_not_followed(read):
    np.testing.assert_allclose(read(saved_73(SPARSE, linked)).matrices.mass.toarray(), M, rtol=1e-14)


def external(file):
    del file["K"]
    file.create_dataset("K", (24, 24), "f8", external=[("other.bin", 0, 24 * 24 * 8)])
    file["K"].attrs["MATLAB_class"] = np.bytes_("double")


def wrong_rows(file):
    file["K/ir"][0] = 500


def bomb(file):
    del file["K"]
    file.create_dataset("K", (20_000, 20_000), "f8", chunks=(1000, 1000), compression="gzip")
    file["K"].attrs["MATLAB_class"] = np.bytes_("double")


GOOD, GOOD_73 = saved(SPARSE), saved_73(SPARSE)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "has no square matrix"),
        (b"\0" * 50_000_000, "no .mat file, or a damaged one"),
        ((bytes(16) + b"\2\0\0\0a\0") * 100_001, "found 100,001 variables, expected at most"),
        (GOOD[:128] + bytes(8) * 100_001, "found 100,001 variables, expected at most"),
        (GOOD[:700], "is cut or damaged"),
        (saved(ARRAYS, do_compression=True)[:300], "is cut or damaged"),
        (
            saved(ARRAYS, do_compression=True).replace(b"x\x9c", b"x\x9d"),
            "a packed variable is damaged",
        ),
        (saved({"K": K, "M": M}, format="4")[:4000], "a variable ends beyond it"),
        (saved({"K": K, "M": M}, format="4")[:10], "it ends within a variable"),
        (b"\x10\x27" + saved({"K": K, "M": M}, format="4")[2:], "no .mat file, or a damaged one"),
        (GOOD_73[:3000], "no whole .mat file"),
        (GOOD_73[:512], "no whole .mat file"),
        (saved({"name": "block", "K": K[:, :3]}), "has no square matrix"),
        (saved({"K": K}), "no mass matrix"),
        (saved({"K": K + 1j, "M": M}), "complex numbers"),
        (saved({"K": K * np.nan, "M": M}), "not finite numbers"),
        (saved_73(SPARSE, external), "in another file"),
        (saved_73(SPARSE, wrong_rows), "no whole .mat file"),
        (saved_73(SPARSE, bomb), "no room for"),
    ],
)
def test_damaged_files_are_refused_in_a_sentence(read, content, words):
    with pytest.raises(VehicleError, match=words):
        read(content)


def test_a_matrix_larger_than_its_file_can_be_is_not_unpacked(read):
    """Its header says 20 000 rows of doubles, behind 100 bytes."""
    content = bytearray(saved({"K": np.zeros((20, 20)), "M": M}))
    place = content.index((20).to_bytes(4, "little") * 2)
    content[place : place + 8] = (20_000).to_bytes(4, "little") * 2
    with pytest.raises(VehicleError, match="other numbers than 20000 by 20000"):
        read(bytes(content))


def test_a_sparse_matrix_with_rows_outside_of_it_is_refused(read):
    """SciPy reads it as it is, and would read beyond its memory with it."""
    content = bytearray(saved(SPARSE))
    rows = sp.csc_array(K).indices.astype("<i4").tobytes()
    place = content.index(rows)
    content[place : place + 4] = (1_000_000).to_bytes(4, "little")
    with pytest.raises(VehicleError, match="variable 'K': its parts make no matrix"):
        read(bytes(content))


def element(order, kind, content):
    return struct.pack(f"{order}II", kind, len(content)) + content + bytes(-len(content) % 8)


def by_hand(order):
    """A file of version 5 whose words are of that order; the name is in a small element."""
    text = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack(f"{order}H", 0x0100)
    content = text + (b"IM" if order == "<" else b"MI")
    for name, A in (("K", K), ("M", M)):
        small = struct.pack(f"{order}I", 1 << 16 | 1) + name.encode().ljust(4, b"\0")
        content += element(
            order,
            14,
            element(order, 6, struct.pack(f"{order}II", 6, 0))
            + element(order, 5, struct.pack(f"{order}ii", *A.shape))
            + small
            + element(order, 9, A.T.astype(f"{order}f8").tobytes()),
        )
    return content


@pytest.mark.parametrize("order", "<>")
def test_words_may_be_in_either_order(read, order):
    component = read(by_hand(order))
    np.testing.assert_array_equal(component.matrices.mass.toarray(), M)
    np.testing.assert_allclose(component.matrices.stiffness.toarray(), K, rtol=1e-14)


def test_packed_variables_that_are_far_more_together_are_refused(read, monkeypatch):
    monkeypatch.setattr("modeviz.formats.matrices.mat_variables.LEAST_IN_ALL", 20_000_000)
    zeros = {f"A{i}": np.zeros((1000, 1000)) for i in range(9)}
    with pytest.raises(VehicleError, match=r"found 24,000,\d+ bytes in packed variables, expected at"):
        read(saved(zeros, do_compression=True))


def test_a_packed_variable_that_unpacks_to_far_more_is_refused(read, monkeypatch):
    monkeypatch.setattr("modeviz.formats.matrices.mat_variables.LEAST_BYTES", 1_000_000)
    content = saved({"K": np.zeros((3000, 3000)), "M": M}, do_compression=True)
    with pytest.raises(VehicleError, match=r"a packed variable of .* has more than"):
        read(content)
