"""Files for other programs, as studies and the command line write them."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from modeviz.analysis.modal_results import ModalResults, solve_modal
from modeviz.export.catalogue import writer
from modeviz.export.solution import ExportOptions, Solution
from modeviz.files.disk import check_writable, write_bytes
from modeviz.study.tuned_vehicle import TunedVehicle


def export_files(
    paths: Sequence[Path], tuned: TunedVehicle, road: str | None, options: ExportOptions
) -> None:
    """Writes files, each whole or not at all; nothing is solved before all can be written.

    Args:
        paths: their names say what they are to have, see `export.catalogue.writer`.
        tuned: the vehicle with its present rates and speed.
        road: its name; None: the vehicle's.
        options: where there is a choice.

    Raises:
        ModevizError: there is no such content, format or road, it cannot be solved, or a file cannot
            be written.
    """
    writers = [writer(path, tuned.vehicle) for path in paths]
    for path in paths:
        check_writable(path)
    solution = Solution(
        tuned.vehicle.with_rates(tuned.rates.by_group),
        tuned.rates.by_group,
        tuned.conditions(road),
        partial(_modes, tuned),
        tuned.prepared,
    )
    for path, make in zip(paths, writers, strict=True):
        write_bytes(path, make(solution, options))


def _modes(tuned: TunedVehicle, below_hz: float) -> ModalResults:
    return solve_modal(tuned.prepared_modes(below_hz), tuned.rates.by_group)
