"""The figures a mount engineer prints: how pure rigid modes are, axes and centres, forces, paths, sag.

Pure functions of a vehicle's matrices, modes and receptances, in SI units.
"""
