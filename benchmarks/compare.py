"""The same work by every method, in turn, in one process."""

from dataclasses import dataclass

from benchmarks import measure
from benchmarks.peers import METHODS, Answer
from benchmarks.report import MethodRow
from benchmarks.work import Work, largest_difference
from modeviz.analysis.preparation import prepare
from modeviz.files import builtin_vehicle, read_vehicle

OURS, REFERENCE, GEMM = "modeviz", "numpy direct", "gemm"
RATES = "optimised"


@dataclass(frozen=True)
class Comparison:
    """What the methods took."""

    rows: list[MethodRow]
    gemm_floor_ratio: float
    not_installed: dict[str, str]
    """By method, why it could not be called."""


def compare(n_freqs: int, n_rounds: int) -> Comparison:
    """Measures every method that is installed, on the built-in truck.

    Args:
        n_freqs: how many of the truck's frequencies, spread over the band.
        n_rounds: how often each method has its turn.
    """
    vehicle = read_vehicle(builtin_vehicle())
    lines = vehicle.frequency_hz
    work = Work(prepare(vehicle, lines[:: len(lines) // n_freqs]), vehicle.rate_sets[RATES])
    answers, missing = _installed(work)
    reference = answers[REFERENCE]()
    differences = {name: largest_difference(call(), reference) for name, call in answers.items()}
    seconds = measure.medians({**answers, GEMM: measure.gemm()}, n_rounds)
    floor = seconds.pop(GEMM) * work.n_operations / measure.GEMM_OPERATIONS
    rows = [
        MethodRow(
            method=name,
            median_ms=1e3 * value,
            times_slower_than_modeviz=value / seconds[OURS],
            max_relative_difference=differences[name],
        )
        for name, value in seconds.items()
    ]
    return Comparison(rows, seconds[OURS] / floor, missing)


def _installed(work: Work) -> tuple[dict[str, Answer], dict[str, str]]:
    """The methods that can be called, and why the others cannot."""
    answers, missing = {}, {}
    for name, get_ready in METHODS.items():
        try:
            answers[name] = get_ready(work)
        except ImportError as error:
            missing[name] = str(error)
    return answers, missing
