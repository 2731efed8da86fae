"""A problem in a file of its own: the [[problem]] of a vehicle.toml, with the unit of its bounds."""

from pathlib import Path
from typing import Annotated

from msgspec import Meta

from modeviz.errors import located
from modeviz.files.records.problems import ProblemRecord
from modeviz.files.records.record import FileRecord
from modeviz.files.schema.scaling import WRITTEN_UNITS
from modeviz.files.toml_reader import read_toml
from modeviz.files.toml_writer import to_toml
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

ENDING = ".toml"

UNITS = {"stiffness": WRITTEN_UNITS["stiffness"]}


class ProblemFileRecord(FileRecord, kw_only=True):
    """The whole file."""

    problem: Annotated[list[ProblemRecord], Meta(min_length=1, max_length=1)]


def problem_text(problem: Problem) -> str:
    """The file of a problem; all but its first table can be put into a vehicle.toml in N/mm."""
    return to_toml(ProblemFileRecord(units=UNITS, problem=[ProblemRecord.of(problem)]))


def read_problem(path: Path | str, vehicle: Vehicle) -> Problem:
    """The problem in a file, for a vehicle.

    Raises:
        VehicleError: the file is missing, damaged or wrong, or names what the vehicle does not have.
    """
    path = Path(path)
    record = read_toml(path, ProblemFileRecord)
    with located(path):
        problem = record.problem[0].build()
        vehicle.check_problem(problem)
    return problem
