"""Derivatives without derivatives, to compare analytic ones with."""

from dataclasses import replace

import numpy as np

from modeviz.vehicle.mount_rates import STIFFNESS_FIELDS


def central_difference(function, at: float, step: float):
    """∂f/∂x at x = `at`, from steps h = `step` x and h/2 extrapolated to none: an error of order h⁴."""
    coarse, fine = (
        (np.asarray(function(at + h)) - np.asarray(function(at - h))) / (2 * h)
        for h in (step * at, step * at / 2)
    )
    return (4 * fine - coarse) / 3


def rate_derivatives(function, rates) -> np.ndarray:
    """Those of a function of all groups' rates with respect to each of their fields, in their order."""
    return np.array(
        [
            central_difference(
                lambda k, g=group, n=name: function({**rates, g: replace(rates[g], **{n: k})}),
                getattr(rates[group], name),
                step=1e-3,
            )
            for group in rates
            for name in STIFFNESS_FIELDS
        ]
    )


def relative_to_largest(found: np.ndarray, expected: np.ndarray, over: int) -> np.ndarray:
    """Differences relative to the largest derivative along one axis: one near zero has no digits."""
    return np.abs(found - expected) / np.abs(expected).max(axis=over, keepdims=True)


def row_error(G, expected):
    """The largest difference relative to the largest of its row."""
    return (np.abs(G - expected).max(axis=2) / np.abs(expected).max(axis=2)).max()
