"""Mass and stiffness matrices of finite-element programs, with the nodes that they move.

NumPy's and SciPy's `.npz` and Matrix Market's `.mtx`; the nodes come as a table.
"""

from modeviz.formats.matrices.reader import SUFFIXES, read_matrices

__all__ = ["SUFFIXES", "read_matrices"]
