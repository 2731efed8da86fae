"""A vehicle with its present rates, and what can be solved of it once a file wants that."""

from collections.abc import Callable
from dataclasses import dataclass

from modeviz.analysis.modal_results import ModalResults
from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle

MOST_ID = 99_000_000
"""The largest first number: a small field has eight columns."""


@dataclass(frozen=True, eq=False)
class Solution:
    """A vehicle with its present rates; modes and responses are solved when they are asked for."""

    vehicle: Vehicle
    """With these rates."""
    rates: Rates
    """Of every mount group."""
    conditions: Callable[[], Conditions]
    """Gives road and speed; raises ModevizError for a vehicle that nothing shakes, or nobody feels."""
    modes: Callable[[float], ModalResults]
    """Gives the modes, those below a frequency, Hz, at least."""
    prepared: Callable[[], Prepared]
    """Gives the vehicle made ready for responses."""
    note: Callable[[str], None]
    """Told what is left out of a file."""

    @property
    def ride(self) -> Conditions | None:
        """Road and speed; None if there are none."""
        try:
            return self.conditions()
        except ModevizError:
            return None


@dataclass(frozen=True, kw_only=True)
class ExportOptions:
    """What is written, where there is a choice."""

    below_hz: float | None = None
    """Modes above are left out; None: those above the vehicle's band."""
    mode: str = ""
    """The name of the one that moves in a motion; "": the lowest that vibrates."""
    units: str = "mm-t-s"
    """Of Nastran cards, one of `UNIT_SYSTEMS`; the others are in SI units."""
    first_id: int = 1
    """From which grids, elements, properties and coordinate systems of Nastran are each counted."""

    def __post_init__(self) -> None:
        if self.below_hz is not None and not 0 < self.below_hz < float("inf"):
            raise ModevizError(f"below: found {self.below_hz:g} Hz, expected more than zero")
        if self.units not in UNIT_SYSTEMS:
            raise ModevizError(
                f"units: found {self.units!r}, expected one of {', '.join(UNIT_SYSTEMS)}"
            )
        if not 1 <= self.first_id <= MOST_ID:
            raise ModevizError(f"first-id: found {self.first_id}, expected 1 to {MOST_ID}")
