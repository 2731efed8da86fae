"""Derivatives without derivatives, to compare analytic ones with."""

import numpy as np


def central_difference(function, at: float, step: float):
    """∂f/∂x at x = `at`, from steps h = `step` x and h/2 extrapolated to none: an error of order h⁴."""
    coarse, fine = (
        (np.asarray(function(at + h)) - np.asarray(function(at - h))) / (2 * h)
        for h in (step * at, step * at / 2)
    )
    return (4 * fine - coarse) / 3


def relative_to_largest(found: np.ndarray, expected: np.ndarray, over: int) -> np.ndarray:
    """Differences relative to the largest derivative along one axis: one near zero has no digits."""
    return np.abs(found - expected) / np.abs(expected).max(axis=over, keepdims=True)


def row_error(G, expected):
    """The largest difference relative to the largest of its row."""
    return (np.abs(G - expected).max(axis=2) / np.abs(expected).max(axis=2)).max()
