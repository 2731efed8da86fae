"""The live answer held against the full model, solved from scratch."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.results import Results
from modeviz.dynamics.modes import RESOLVED_HZ, Modes
from modeviz.dynamics.response import direct_response
from modeviz.errors import SolveError
from modeviz.ride.excitation import generalised_forces, input_spectrum
from modeviz.ride.psd import FLOOR, acceleration_psd
from modeviz.vehicle.arrays import Floats

LINES_AT_ONCE = 10
"""Of the frequencies at which responses are compared."""


@dataclass(frozen=True)
class Check:
    """How far an answer is from the exact one."""

    frequency_error: float
    """Largest relative difference of natural frequencies; infinite if their number differs."""
    psd_error: float
    """Largest difference of PSDs, relative to the largest of that response; of one below the floor
    that is drawn, relative to the floor."""
    n_lines: int
    """At how many frequencies PSDs were compared."""
    n_freqs: int
    """How many frequencies there are."""
    impossible: str = ""
    """Why the full model cannot be solved exactly enough to compare more, if it cannot."""

    @property
    def is_complete(self) -> bool:
        """Whether all is compared that can be."""
        return self.n_lines == self.n_freqs or bool(self.impossible)

    @property
    def error(self) -> float:
        """The larger of both."""
        return float(np.max([self.frequency_error, self.psd_error]))


def check_exactly(results: Results) -> Iterator[Check]:
    """Compares results with the eigenproblem and the equations of motion of the full model.

    Every value tells what is known by then: first modes alone, then responses at more and more
    frequencies, coarse ones first, until all are compared. Whoever has seen enough stops.
    """
    exact = solve_modal(results.prepared, results.rates, "exact")
    check = Check(_frequency_error(results.modes, exact.modes), 0.0, 0, len(results.frequency_hz))
    yield check
    system = results.prepared.system_at(results.rates)
    load, speed = results.drive.load, results.conditions.speed
    largest = results.psd.max(axis=0, initial=FLOOR)
    for lines in _coarse_first(len(results.frequency_hz)):
        f = results.frequency_hz[lines]
        forces = generalised_forces(system, load, f, speed)
        try:
            H = direct_response(system, f, forces, results.prepared.outputs)
        except SolveError as error:
            yield replace(check, impossible=str(error))
            return
        psd = acceleration_psd(f, H, input_spectrum(load, f, speed)).reshape(len(f), -1, 3)
        relative = np.abs(psd - results.psd[lines]) / largest
        psd_error = float(relative.max(initial=check.psd_error))
        check = replace(check, psd_error=psd_error, n_lines=check.n_lines + len(f))
        yield check


def checked(results: Results, tell: Callable[[float], None] = lambda _: None) -> Check:
    """Return how far results are from those of the full model, all compared.

    Args:
        results: an answer.
        tell: told the fraction that is done.
    """
    check = None
    for check in check_exactly(results):
        tell(check.n_lines / check.n_freqs)
    assert check is not None
    return check


@dataclass(frozen=True)
class ClassicError:
    """How far the base modes alone, the paper's equation, are off."""

    mode: int
    """The mode that is worst, an index."""
    frequency_hz: float
    """What the classic method gives for it."""
    error: float
    """Relative to its frequency."""


def classic_error(results: Results) -> ClassicError | None:
    """The largest error that the classic method makes with the same rates; None without modes.

    Modes are compared in rising order: by the minimax principle each is found too high, so of those
    near the top of the band some may be missing.
    """
    classic = solve_modal(results.prepared, results.rates, "classic").modes.frequency_hz
    true = results.modes.frequency_hz[: len(classic)]
    errors = _relative(classic, true)
    if not errors.size:
        return None
    worst = int(errors.argmax())
    return ClassicError(worst, float(classic[worst]), float(errors[worst]))


def _frequency_error(modes: Modes, exact: Modes) -> float:
    if len(modes.frequency_hz) != len(exact.frequency_hz):
        return np.inf
    return float(_relative(modes.frequency_hz, exact.frequency_hz).max(initial=0.0))


def _relative(found: Floats, true: Floats) -> Floats:
    """Relative errors of frequencies, (n_modes,); zero for what moves freely."""
    difference = np.abs(found - true)
    return np.divide(difference, true, out=np.zeros_like(true), where=true > RESOLVED_HZ)


def _coarse_first(n_freqs: int) -> Iterator[NDArray[np.intp]]:
    """Return all lines in chunks, each spread evenly over the band."""
    n_chunks = -(-n_freqs // LINES_AT_ONCE)
    golden = (np.sqrt(5) - 1) / 2
    for start in np.argsort(np.arange(n_chunks) * golden % 1):
        yield np.arange(start, n_freqs, n_chunks)
