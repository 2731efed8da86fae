"""Universal files (.unv, .uff), as test systems and solvers write them.

Read here and not by pyuff (2.5.8: 0.7 MB, needs NumPy alone, kept up): it goes through these data sets
line by line in Python, and gives what it has of a file that is cut. The tests write files with it.
"""

from modeviz.formats.universal.reader import SUFFIXES as SUFFIXES
from modeviz.formats.universal.reader import read_universal as read_universal
