"""Fits the pickup's parameters to the paper's tables: python assets/calibrate_truck.py [ROUNDS].

Bounded least squares from the values in `pickup.parameters`, on the very vehicle that is built; it
prints what to put there. Fitted are Table 1, the cab yaw at the optimised rates, the fall of the
lateral acceleration on road 1, and Tables 5 and 6. A round takes some minutes.
"""

import sys
from dataclasses import asdict, fields, replace

import numpy as np
from compare_with_paper import CAB_YAW_OPTIMISED, LOADS, WHEEL_ACCELERATIONS, Comparison, compare
from pickup.parameters import Parameters
from pickup.vehicle import pickup
from scipy.optimize import least_squares

from modeviz.fem.component import flexible_body
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody

BOUNDS = {f.name: f.metadata["bounds"] for f in fields(Parameters)}
LOW, HIGH = np.array(list(BOUNDS.values()), float).T

FREQUENCY_TOLERANCE = 0.003
"""Relative: what the last digit of Table 1 is worth."""
CHANGE_TOLERANCE = 0.6
"""Of a logarithm: of a wheel response's change by the optimised mounts, and of its level."""
LEAST_CHANGE = 0.03
"""Of a logarithm: a change must be this far on the paper's side of none to count as right."""
SIGN_TOLERANCE = 0.05
LATERAL_FALL = 0.39
LATERAL_TOLERANCE = 0.02
LOST = 3.0
"""Tolerances off, everywhere, when a mode of the paper has no name."""
STEP_TOLERANCE = 0.3
"""Fraction of its bounds a parameter may move before that costs as much as one tolerance."""


class Memory:
    """Solves a component again only when its mesh or its attachments have changed."""

    def __init__(self) -> None:
        self._solved: dict[tuple, FlexibleBody] = {}

    def __call__(self, name, role, label, mesh, attachments, n_modes, damping_ratio, display, k, m):
        places = tuple((a.name, a.position.tobytes(), a.directions) for a in attachments)
        key = (name, places, mesh.beam_sections)
        if key not in self._solved:
            self._solved[key] = flexible_body(
                name, role, label, mesh, attachments, n_modes, damping_ratio
            )
        body = self._solved[key]
        # (K k - ω² M m) φ = 0 has the same shapes, scaled: so have the residual vectors.
        return replace(
            body,
            omega_n_squared=body.omega_n_squared * k / m,
            attachments=tuple(replace(a, shapes=a.shapes / np.sqrt(m)) for a in body.attachments),
            shapes=body.shapes / np.float32(np.sqrt(m)),
        )


def parameters(z: Floats) -> Parameters:
    """The parameters at fractions `z` of their bounds."""
    return Parameters(*map(float, LOW + z * (HIGH - LOW)))


def fractions(p: Parameters) -> Floats:
    """Where in their bounds the parameters are, 0 to 1."""
    return np.clip((np.array(list(asdict(p).values())) - LOW) / (HIGH - LOW), 0, 1)


def misfit(comparison: Comparison) -> Floats:
    """How far from the paper, in tolerances."""
    frequencies = np.log1p(comparison.frequency_errors)
    yaw = np.log(comparison.cab_yaw_optimised / CAB_YAW_OPTIMISED)
    ours, paper = np.log(comparison.wheel_accelerations), np.log(WHEEL_ACCELERATIONS)
    levels = ours - paper - level_offsets(comparison)[:, None, None]
    change, wanted = np.diff(ours)[..., 0], np.diff(paper)[..., 0]
    least = np.minimum(np.abs(wanted) / 2, LEAST_CHANGE)
    return np.concatenate(
        [
            np.append(frequencies, yaw) / FREQUENCY_TOLERANCE,
            levels.ravel() / CHANGE_TOLERANCE,
            (change - wanted).ravel() / CHANGE_TOLERANCE,
            np.maximum(least - np.sign(wanted) * change, 0).ravel() / SIGN_TOLERANCE,
            [max(comparison.lateral_change + LATERAL_FALL, 0) / LATERAL_TOLERANCE],
        ]
    )


def level_offsets(comparison: Comparison) -> Floats:
    """Mean log ratio of ours to the paper's, by load: what the forces' free amplitudes take up."""
    ratio = np.log(comparison.wheel_accelerations / WHEEL_ACCELERATIONS)
    return ratio.mean(axis=(0, 2, 3))


def calibrate(rounds: int) -> Parameters:
    """The best parameters after so many Gauss-Newton rounds from the present ones."""
    memory, start = Memory(), fractions(Parameters())
    lost = np.full_like(misfit(compare(pickup(Parameters(), memory))), LOST)

    def residual(z: Floats) -> Floats:
        try:
            found = misfit(compare(pickup(parameters(z), memory)))
        except ValueError:  # a mode has lost its name
            found = lost
        return np.append(found, (z - start) / STEP_TOLERANCE)

    inside = np.clip(start, 1e-4, 1 - 1e-4)
    best = least_squares(
        residual, inside, bounds=(0, 1), diff_step=2e-3, max_nfev=rounds + 1, verbose=2
    )
    return parameters(best.x)


if __name__ == "__main__":
    result = calibrate(int(sys.argv[1]) if len(sys.argv) > 1 else 3)
    for name, value in asdict(result).items():
        print(f"{name} = {value:.6g}")
    comparison = compare(pickup(result))
    for load, offset in zip(LOADS, level_offsets(comparison), strict=True):
        print(f"{load}: multiply by {np.exp(-offset):.3f}")
