"""Files for other programs, as studies and the command line write them."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from modeviz.analysis.modal_results import ModalResults, solve_modal
from modeviz.export.catalogue import writer
from modeviz.export.solution import ExportOptions, Solution
from modeviz.files.disk import check_each_once, check_writable, write_bytes
from modeviz.mounting.working_point import working_point
from modeviz.study.conditions import road_conditions
from modeviz.study.tuned_vehicle import TunedVehicle


def export_files(
    paths: Sequence[Path],
    tuned: TunedVehicle,
    road: str | None,
    options: ExportOptions,
    note: Callable[[str], None],
) -> None:
    """Writes files, each whole or not at all; nothing is solved before all can be written.

    Args:
        paths: their names say what they are to have, see `export.catalogue.writer`.
        tuned: the vehicle with its present rates and speed.
        road: its name; None: the vehicle's.
        options: where there is a choice.
        note: told what is left out of a file.

    Raises:
        ModevizError: there is no such content, format or road, it cannot be solved, or a file is there
            twice or cannot be written.
    """
    check_each_once(paths)
    writers = [writer(path, tuned.vehicle) for path in paths]
    for path in paths:
        check_writable(path)
    tuned.conditions(road)  # that there is no such road is said even if no file is of one
    solution = Solution(
        working_point(tuned.vehicle).vehicle(tuned.vehicle, tuned.rates.by_group),
        tuned.rates.by_group,
        partial(road_conditions, tuned.vehicle, road, tuned.speed),
        partial(_modes, tuned),
        tuned.prepared,
        note,
    )
    for path, make in zip(paths, writers, strict=True):
        write_bytes(path, make(solution, options))


def _modes(tuned: TunedVehicle, below_hz: float) -> ModalResults:
    return solve_modal(tuned.prepared_modes(below_hz), tuned.rates.by_group)
