"""The vehicle folder on disk: the only reader and writer."""

from modeviz.vehicle.files.folder import builtin_vehicle as builtin_vehicle
from modeviz.vehicle.files.folder import read_vehicle as read_vehicle
from modeviz.vehicle.files.folder import write_vehicle as write_vehicle
from modeviz.vehicle.files.problem_file import read_problem as read_problem
