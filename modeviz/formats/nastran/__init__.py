"""Nastran: modes of SOL 103 from its files of results, with their geometry or that of the input.

Both are read here, so that nothing is to be installed. Weighed were pyNastran 1.4.1 (8 MB; reads nearly
all tables; declares numpy<2, so that pip exchanges a NumPy of today for 1.26.4) and pyyeti 1.4.7 (kept
up, reads matrices and superelements; but brings numba with llvmlite, pandas and matplotlib, 360 MB
in all, takes 5 s to import, and has no elements of an OP2 file). What is wanted are four tables and a
dozen cards, and what damaged files may take of memory and time is in our hands.
HDF5 takes h5py, an extra.
"""

from modeviz.formats.nastran.punch_modes import has_punched_modes as has_punched_modes
from modeviz.formats.nastran.reader import SUFFIXES as SUFFIXES
from modeviz.formats.nastran.reader import read_nastran as read_nastran
