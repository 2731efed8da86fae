"""Universal files (.unv, .uff), as test systems and solvers write them.

Read here, so that nothing is to be installed. Weighed was pyuff 2.5.8 (0.7 MB, needs NumPy alone, kept
up, as fast: 50 MB in 1.8 s): of a file that is cut it gives what it has without a word, and coordinate
systems and kinds of elements and of data would be ours to sort out anyway. Tests write files with it.
"""

from modeviz.formats.universal.reader import SUFFIXES as SUFFIXES
from modeviz.formats.universal.reader import read_universal as read_universal
