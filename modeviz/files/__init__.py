"""The vehicle folder on disk: the only reader and writer."""

from modeviz.files.folder import builtin_vehicle as builtin_vehicle
from modeviz.files.folder import read_vehicle as read_vehicle
from modeviz.files.folder import write_vehicle as write_vehicle
from modeviz.files.problem_file import read_problem as read_problem
