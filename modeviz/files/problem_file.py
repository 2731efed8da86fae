"""A problem in a file of its own: the [[problem]] of a vehicle.toml, with the unit of its bounds."""

from pathlib import Path
from typing import Annotated

from msgspec import Meta

from modeviz.errors import located
from modeviz.files.records.problems import ProblemRecord
from modeviz.files.records.record import FileRecord
from modeviz.files.toml_reader import read_toml
from modeviz.files.toml_writer import to_toml
from modeviz.units import WRITTEN_UNITS
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

ENDING = ".toml"


class ProblemFileRecord(FileRecord, kw_only=True):
    """The whole file."""

    problem: Annotated[list[ProblemRecord], Meta(min_length=1, max_length=1)]


def problem_text(problem: Problem) -> str:
    """The file of a problem; all but its first table can be put into a vehicle.toml in N/mm."""
    return to_toml(ProblemFileRecord(units=_units(problem), problem=[ProblemRecord.of(problem)]))


def _units(problem: Problem) -> dict[str, str]:
    """The units of what a problem has."""
    has_lengths = problem.deflections or any(group.offsets for group in problem.groups)
    used = {
        "stiffness": True,
        "length": has_lengths,
        "angle": any(group.angles for group in problem.groups),
    }
    return {name: WRITTEN_UNITS[name] for name in WRITTEN_UNITS if used.get(name)}


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
