"""What the modes left out of a free body add under loads: residual vectors, used like more modes."""

import numpy as np
import scipy.linalg as sl
import scipy.sparse as sp

from modeviz.fem.free import ModalBasis, inertia_relief, norms, signed, static_response, without
from modeviz.fem.matrices import Matrices
from modeviz.vehicle.arrays import Floats

ROUNDING = 1e-9
"""Of a response, what solving and projecting may leave where nothing is left."""

DEPENDENT = 1e-10
"""Vectors whose rest beyond others has less than this part of their energy repeat them."""

FURTHER = 2.0
"""Up to so many times the highest kept frequency, what loads excite beyond the modes is kept apart."""


def residual_response(matrices: Matrices, modes: ModalBasis, loads: Floats) -> Floats:
    """The static displacement under loads beyond that in the given free modes, (n_dofs, n_loads).

    The inertia-relief response u less its part in the modes, Φ Φᵀ M u = Φ Ω⁻² Φᵀ f. Zero where only
    rounding is left.
    """
    return _beyond(modes, static_response(matrices, loads), matrices.mass)


def residual_vectors(matrices: Matrices, modes: ModalBasis, loads: Floats) -> ModalBasis:
    """Vectors that make the static response to the loads exact when joined to the free modes.

    They span `residual_response`, are orthonormal in mass and orthogonal in stiffness, among
    themselves and to the modes. The stiff ones count: leaving them out of the truck costs up to 2 %
    in frequency. Only those that repeat others are left out.

    Args:
        matrices: of the body.
        modes: its free modes.
        loads: (n_dofs, n_loads), N and N m.
    """
    return _ritz(matrices, residual_response(matrices, modes, loads))


def dynamic_residual_vectors(matrices: Matrices, modes: ModalBasis, loads: Floats) -> ModalBasis:
    """Vectors as `residual_vectors`, with some more that make the response exact to ω² as well.

    Two steps of the block Krylov method, u₁ = K⁻¹ f and u₂ = K⁻¹ M u₁ beyond the modes: the next terms
    of the response in powers of ω² (E. J. Grimme, 1997). Of their Ritz vectors those up to `FURTHER`
    times the highest kept frequency are kept, and what loads do statically to all others together.
    Two bodies that stiff springs join then have frequencies within 1e-6 of the full models' below
    half of the highest kept one, where static residual vectors alone leave 5e-5.

    Args:
        matrices: of the body.
        modes: its free modes.
        loads: (n_dofs, n_loads), N and N m.
    """
    M = matrices.mass
    respond = inertia_relief(matrices)
    first = _orthonormal(_beyond(modes, respond(loads), M), M)
    second = _beyond(modes, respond(M @ first), M)
    ritz = _ritz(matrices, np.hstack([first, second]))
    is_low = ritz.omega_n_squared < FURTHER**2 * modes.omega_n_squared[-1]
    rest = _static_rest(ritz.omega_n_squared[~is_low], ritz.shapes[:, ~is_low], loads)
    omega_n_squared = np.r_[ritz.omega_n_squared[is_low], rest.omega_n_squared]
    order = np.argsort(omega_n_squared)
    shapes = np.hstack([ritz.shapes[:, is_low], rest.shapes])
    return ModalBasis(omega_n_squared[order], signed(shapes[:, order]))


def _static_rest(omega_n_squared: Floats, shapes: Floats, loads: Floats) -> ModalBasis:
    """Of orthogonal vectors the combinations that deflect under static loads."""
    omega = np.sqrt(omega_n_squared)[:, None]
    strain = (shapes.T @ loads) / omega  # energy is the square of these
    energy = np.linalg.norm(strain, axis=0)
    strain = strain[:, energy > 0] / energy[energy > 0]
    axes, sizes, _ = np.linalg.svd(strain, full_matrices=False)
    axes = axes[:, sizes > np.sqrt(DEPENDENT) * sizes.max(initial=0.0)] / omega
    flexibility, rotation = np.linalg.eigh(axes.T @ axes)
    return ModalBasis(1 / flexibility, shapes @ (axes @ (rotation / np.sqrt(flexibility))))


def _ritz(matrices: Matrices, u: Floats) -> ModalBasis:
    """The vectors that some span, orthonormal in mass and orthogonal in stiffness."""
    for _ in range(2):
        u = _orthonormal(u, matrices.mass)
    k = u.T @ (matrices.stiffness @ u)
    omega_n_squared, rotation = sl.eigh((k + k.T) / 2)
    return ModalBasis(omega_n_squared, signed(u @ rotation))


def _beyond(modes: ModalBasis, u: Floats, mass: sp.csc_array) -> Floats:
    """The part of displacements that the modes do not have, zero where only rounding is left."""
    rest = u
    for _ in range(2):
        rest = without(modes.shapes, rest, mass)
    return rest * (norms(rest, mass) > ROUNDING * norms(u, mass))


def _orthonormal(u: Floats, mass: sp.csc_array) -> Floats:
    """A basis, orthonormal in mass, of what the columns of `u` span."""
    sizes = norms(u, mass)
    u = u[:, sizes > 0] / sizes[sizes > 0]
    gram, rotation = np.linalg.eigh(u.T @ (mass @ u))
    kept = gram > DEPENDENT * gram.max(initial=0.0)
    return u @ (rotation[:, kept] / np.sqrt(gram[kept]))
