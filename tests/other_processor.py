"""Makes one processor stand for all others: what LAPACK gives differs in its last bits at every call.

    scripts/test -p other_processor -m "not bitwise and not browser"

finds tests, and code under test, that hang on the bits of one kind of processor.
"""

from functools import wraps

import numpy as np
import scipy.linalg
import scipy.sparse.linalg

SIZE = 4 * np.finfo(np.float64).eps
FUNCTIONS = {
    np: ("einsum",),
    np.linalg: (
        "cholesky", "eig", "eigh", "eigvals", "eigvalsh", "inv", "lstsq", "pinv", "qr", "solve", "svd",
    ),
    scipy.linalg: (
        "cholesky", "eig", "eigh", "eigvalsh", "eigvalsh_tridiagonal", "expm", "lstsq", "lu_solve",
        "qr", "solve", "solve_triangular",
    ),
    scipy.sparse.linalg: ("eigsh", "spsolve"),
}  # fmt: skip

_random = np.random.default_rng(1)


def _rounded_otherwise(value):
    """The same with floats off by a few last bits; zeros stay, as they do on any processor."""
    if isinstance(value, tuple):
        items = [_rounded_otherwise(item) for item in value]
        return type(value)(*items) if hasattr(value, "_fields") else tuple(items)
    if isinstance(value, np.ndarray) and value.dtype in (np.float64, np.complex128):
        return value * (1 + SIZE * _random.uniform(-1, 1, value.shape))
    if isinstance(value, float):
        return type(value)(value * (1 + SIZE * _random.uniform(-1, 1)))
    return value


def _otherwise(function):
    @wraps(function)
    def otherwise(*arguments, **keywords):
        return _rounded_otherwise(function(*arguments, **keywords))

    return otherwise


for module, names in FUNCTIONS.items():
    for name in names:
        setattr(module, name, _otherwise(getattr(module, name)))
