import numpy as np
import pytest
import scipy.sparse as sp
import scipy.sparse.linalg as spl
from small_meshes import bar, plate

from modeviz.fem import ordering
from modeviz.fem.free import free_modes, free_modes_up_to, static_response
from modeviz.fem.matrices import assemble
from modeviz.fem.ordering import dissected, elimination_order


def cube(n):
    """Nodes of a cubic lattice, and what joins neighbours, as of solid elements."""
    places = np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    line = sp.diags_array([1.0, 1.0, 1.0], offsets=[-1, 0, 1], shape=(n, n))
    return places.astype(float), sp.csr_array(sp.kron(sp.kron(line, line), line))


def fill(A, order, spec="NATURAL"):
    options = {"SymmetricMode": True}
    return spl.splu(
        sp.csc_array(A[order][:, order]), permc_spec=spec, diag_pivot_thresh=0.0, options=options
    ).nnz


def test_every_node_has_its_turn_once():
    nodes, joined = cube(9)
    assert sorted(dissected(nodes, joined)) == list(range(729))


def test_solids_are_filled_less_than_in_the_order_of_minimum_degree():
    nodes, joined = cube(16)
    A = sp.csr_array(joined + 100 * sp.eye_array(len(nodes)))
    as_they_are = np.arange(len(nodes))
    least = fill(A, as_they_are, "MMD_AT_PLUS_A")
    assert fill(A, dissected(nodes, joined)) < 0.9 * least < fill(A, as_they_are)


def test_halves_that_are_eliminated_first_do_not_touch():
    nodes, joined = cube(12)
    order = dissected(nodes, joined)
    last = np.flatnonzero(np.isin(order, np.flatnonzero(nodes[:, 0] == 5)))
    assert last.min() >= len(nodes) - 144
    left, right = (np.flatnonzero(part) for part in (nodes[:, 0] < 5, nodes[:, 0] > 5))
    assert joined[left][:, right].nnz == 0


@pytest.mark.parametrize("mesh", [plate(6), bar(40)])
def test_large_bodies_have_the_same_modes_and_deflections_in_this_order(monkeypatch, mesh):
    body = assemble(mesh)
    f = np.zeros((body.n_dofs, 2))
    f[2, 0] = f[13, 1] = 1.0
    expected = free_modes(body, 12), static_response(body, f)
    assert elimination_order(body) is None
    monkeypatch.setattr(ordering, "LARGE", 0)
    assert sorted(elimination_order(body)) == list(range(body.n_dofs))
    found = free_modes(body, 12), static_response(body, f)
    np.testing.assert_allclose(found[0].omega_n_squared, expected[0].omega_n_squared, rtol=1e-7)
    np.testing.assert_allclose(found[1], expected[1], atol=1e-8 * abs(expected[1]).max())
    up_to = free_modes_up_to(body, np.sqrt(expected[0].omega_n_squared[9]) / (2 * np.pi) + 0.1, 60)
    np.testing.assert_allclose(
        up_to.omega_n_squared[6:10], expected[0].omega_n_squared[6:10], rtol=1e-7
    )
