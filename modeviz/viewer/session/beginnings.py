"""The answers with which sessions of a vehicle begin, solved and looked into once for all of them."""

import threading
from collections.abc import Sequence
from dataclasses import dataclass, field

from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Conditions, Results, RoadExcitation, drive, solve_on
from modeviz.vehicle.alterations import Alterations
from modeviz.vehicle.mount_rates import Rates
from modeviz.viewer.session.inquiry import Inquiry


@dataclass(eq=False)
class _Beginning:
    """A set of rates with which sessions begin or compare, and what there is of it by now."""

    rates: Rates
    lock: threading.Lock = field(default_factory=threading.Lock)
    inquiry: Inquiry | None = None
    near: Prepared | None = None


class Beginnings:
    """Keeps what sessions have in common as long as they are new; any thread may ask."""

    def __init__(self, conditions: Conditions | None = None, rates: Sequence[Rates] = ()) -> None:
        """Solves nothing yet.

        Args:
            conditions: with which sessions begin; None: they have nothing in common.
            rates: with which they begin, and with which they compare, of all groups.
        """
        self._conditions = conditions
        self._beginnings = [_Beginning(each) for each in rates]
        self._lock = threading.Lock()
        self._drive: RoadExcitation | None = None

    def drive(
        self, prepared: Prepared, alterations: Alterations, conditions: Conditions
    ) -> RoadExcitation:
        """Return the vehicle on the road, the same for all where it is as in its file.

        Args:
            prepared: the vehicle.
            alterations: of it.
            conditions: with which it is asked for.

        Raises:
            ModevizError: as `analysis.results.drive`.
        """
        if conditions != self._conditions or alterations != Alterations():
            return drive(prepared, conditions)
        with self._lock:
            if self._drive is None:
                self._drive = drive(prepared, conditions)
            return self._drive

    def solve(self, excitation: RoadExcitation, rates: Rates) -> Results:
        """Return the results with rates; raises as `solve_on`."""
        beginning = self._beginning(excitation.prepared, rates)
        if beginning is None or excitation is not self._drive:
            return solve_on(excitation, rates)
        with beginning.lock:
            if beginning.inquiry is None:
                beginning.inquiry = Inquiry(solve_on(excitation, rates))
            return beginning.inquiry.findings.now

    def near(self, prepared: Prepared, rates: Rates) -> Prepared:
        """Return `prepared.near` rates; raises likewise."""
        beginning = self._beginning(prepared, rates)
        if beginning is None:
            return prepared.near(rates)
        with beginning.lock:
            if beginning.near is None:
                beginning.near = prepared.near(rates)
            return beginning.near

    def inquiry(self, now: Results) -> Inquiry:
        """Return what looks into results; others may look into the same."""
        inquiries = (each.inquiry for each in self._beginnings)
        known = (each for each in inquiries if each and each.findings.now is now)
        return next(known, None) or Inquiry(now)

    def _beginning(self, prepared: Prepared, rates: Rates) -> _Beginning | None:
        """Return that with some rates of the vehicle as it is in its file, if there is one."""
        if self._drive is None or prepared is not self._drive.prepared:
            return None
        return next((each for each in self._beginnings if each.rates == rates), None)
