"""Operating deflection shapes: how a vehicle moves at one frequency under random inputs."""

import numpy as np

from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Complexes, Floats

QUIET = 1e-9
"""A reference that moves less than this part of what its coordinates could add up to only shows their
rounding."""


def operating_shape(displacement: Complexes, input_psd: Complexes, reference: Floats) -> Complexes:
    """The shape of a random motion at one frequency as seen from a reference, (n_dofs,), m/√Hz.

    G_xr / √G_rr with the cross spectra G = H S_ff Hᴴ. Several inputs have no phase of their own; the
    cross spectrum has that to the reference, where the shape is real and the root of the PSD. It is the
    part of the motion that is coherent with the reference, and all of it where one input acts or all
    are fully coherent (B. J. Schwarz, M. H. Richardson, "Introduction to operating deflection shapes",
    CSI Reliability Week, 1999, for shapes out of cross spectra; J. S. Bendat, A. G. Piersol, "Random
    Data", for the coherent part).

    Args:
        displacement: H, (n_dofs, n_inputs), of every coordinate per unit of each input.
        input_psd: S_ff, (n_inputs, n_inputs), one-sided.
        reference: row (n_dofs,) that reads it.

    Raises:
        SolveError: the reference does not move.
    """
    H, S = displacement, input_psd
    H_r = reference @ H
    power = float(np.real(H_r @ S @ H_r.conj()))
    largest = np.abs(reference) @ np.abs(H)
    rounding = QUIET**2 * float(largest @ np.abs(S) @ largest)
    if not power > max(rounding, float(np.finfo(float).tiny)):
        raise SolveError("the reference does not move there: choose another point or direction")
    return H @ (S @ H_r.conj()) / np.sqrt(power)
