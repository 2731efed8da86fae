"""The built-in truck, read and prepared once for all tests of a process, which change nothing of it."""

from functools import cache

from modeviz.analysis.preparation import prepare, prepare_modes
from modeviz.files import builtin_vehicle, read_vehicle


@cache
def builtin_truck():
    return read_vehicle(builtin_vehicle())


@cache
def truck_modes():
    return prepare_modes(builtin_truck())


@cache
def prepared_truck():
    return prepare(builtin_truck())
