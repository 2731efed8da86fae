"""Ansys's binary files, read by ansys-mapdl-reader (extra `ansys`) in a process of its own.

Modes and geometry of results (`.rst`), mass and stiffness of the full model (`.full`). That library
is the only maintained one for these files; it draws with VTK, and damaged files may make it end without
a word, which is why it has a process to itself. Its maintainers say that it does not know the
compression of newer results: numbers like 1e172 between zeros, which are refused here.
"""

from modeviz.formats.ansys.reader import FULL, RESULTS, read_ansys, read_full

__all__ = ["FULL", "RESULTS", "read_ansys", "read_full"]
