"""Mass and stiffness matrices of finite-element programs, with the nodes that they move.

NumPy's and SciPy's `.npz`, Matrix Market's `.mtx`, MATLAB's `.mat`, Abaqus's and CalculiX's `.mtx`;
those of Nastran and Ansys are read beside these programs' other files. The nodes come as a table or
from a file of another format.
"""

from modeviz.formats.matrices.reader import SUFFIXES, read_matrices

__all__ = ["SUFFIXES", "read_matrices"]
