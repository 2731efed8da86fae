"""Matrices that pyyeti writes, which is nobody's here, and what it finds in those of the tests."""

import elsewhere
import numpy as np
import pytest
from free_network import LABELS, free_network
from op4_files import dmig, op4_binary, op4_text

from modeviz.formats.named_matrices import symmetric
from modeviz.formats.nastran.input_file import read_input
from modeviz.formats.nastran.op4 import read_op4

NETWORK = free_network()
MATRICES = {"K": NETWORK.stiffness, "M": NETWORK.mass}
DIRECTIONS = np.column_stack([np.repeat(LABELS, 3), np.tile([1, 2, 3], 8)])


@pytest.mark.parametrize("sparse", ["dense", "bigmat", "nonbigmat"])
@pytest.mark.parametrize("order", ["<", ">", "text"])
def test_matrices_that_another_program_writes_are_read_as_they_were(tmp_path, sparse, order):
    """To the last bit of what is binary, and to the sixteen digits of text."""
    path, is_text = tmp_path / "a.op4", order == "text"
    how = {"binary": not is_text, "digits": 16, "endian": "" if is_text else order, "sparse": sparse}
    elsewhere.op4.write(str(path), MATRICES, **how)
    found = {matrix.name: matrix.matrix.toarray() for matrix in read_op4(path)}
    assert set(found) == set(MATRICES)
    for name, A in MATRICES.items():
        np.testing.assert_allclose(found[name], A, rtol=1e-15 if is_text else 0)


@pytest.mark.parametrize("form", ["full", "strings", "wide"])
@pytest.mark.parametrize("order", ["<", ">", "text"])
def test_another_program_reads_what_the_tests_write(tmp_path, form, order):
    path, is_text = tmp_path / "a.op4", order == "text"
    path.write_bytes(op4_text(MATRICES, form) if is_text else op4_binary(MATRICES, form, order))
    found = elsewhere.op4.read(str(path), sparse=False)
    for name, A in MATRICES.items():
        np.testing.assert_allclose(found[name.lower()], A, rtol=1e-15 if is_text else 0)


def test_another_program_finds_the_same_matrix_in_cards(tmp_path):
    path = tmp_path / "k.pch"
    path.write_text(dmig("K", NETWORK.stiffness, DIRECTIONS))
    theirs = elsewhere.bulk.rddmig(str(path))["k"]
    (ours,) = read_input(path).matrices
    np.testing.assert_array_equal(ours.labels, theirs.index.to_frame().to_numpy())
    np.testing.assert_allclose(symmetric(ours).toarray(), theirs.to_numpy(), rtol=1e-12)
