"""The vehicle folder on disk: the only reader and writer.

`folder` reads and writes it whole. `records` has the tables of vehicle.toml and what each becomes, a
module for bodies, connections, loads, problems; `schema` checks them and converts units and axes. The
other modules are files: modes (.npz), meshes, roads and spectra (.csv), rates, problems of their own.
"""

from modeviz.files.folder import builtin_vehicle as builtin_vehicle
from modeviz.files.folder import read_vehicle as read_vehicle
from modeviz.files.folder import write_vehicle as write_vehicle
from modeviz.files.problem_file import read_problem as read_problem
