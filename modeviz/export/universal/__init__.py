"""Universal files: geometry, modes and functions as test systems and solvers read them.

Written here; pyuff 2.5.8, which tests read them with, writes units and functions in a format of its own
choice, and would be an installed dependency for some format strings.
"""
