"""The answers with which sessions of a vehicle begin, solved and looked into once for all of them."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial

from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Conditions, Results, RoadExcitation, drive, solve_on
from modeviz.vehicle.alterations import Alterations
from modeviz.vehicle.mount_rates import Rates
from modeviz.viewer.session.inquiry import Inquiry
from modeviz.viewer.session.once import Once


@dataclass(frozen=True, eq=False)
class _Beginning:
    """A set of rates with which sessions begin or compare, and what there is of it by now."""

    rates: Rates
    inquiry: Once[Inquiry] = field(default_factory=Once)
    near: Once[Prepared] = field(default_factory=Once)


class Beginnings:
    """Keeps what sessions have in common as long as they are new; any thread may ask.

    Where that takes one of them long, or hangs, the others do it themselves, see `Once`.
    """

    def __init__(self, conditions: Conditions | None = None, rates: Sequence[Rates] = ()) -> None:
        """Solves nothing yet.

        Args:
            conditions: with which sessions begin; None: they have nothing in common.
            rates: with which they begin, and with which they compare, of all groups.
        """
        self._conditions = conditions
        self._beginnings = [_Beginning(each) for each in rates]
        self._drive: Once[RoadExcitation] = Once()

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
        return self._drive.get(partial(drive, prepared, conditions))

    def solve(self, excitation: RoadExcitation, rates: Rates) -> Results:
        """Return the results with rates; raises as `solve_on`."""
        beginning = self._beginning(excitation.prepared, rates)
        if beginning is None or excitation is not self._drive.known:
            return solve_on(excitation, rates)
        return beginning.inquiry.get(lambda: Inquiry(solve_on(excitation, rates))).findings.now

    def near(self, prepared: Prepared, rates: Rates) -> Prepared:
        """Return `prepared.near` rates; raises likewise."""
        beginning = self._beginning(prepared, rates)
        if beginning is None:
            return prepared.near(rates)
        return beginning.near.get(partial(prepared.near, rates))

    def inquiry(self, now: Results) -> Inquiry:
        """Return what looks into results; others may look into the same."""
        inquiries = (each.inquiry.known for each in self._beginnings)
        known = (each for each in inquiries if each and each.findings.now is now)
        return next(known, None) or Inquiry(now)

    def _beginning(self, prepared: Prepared, rates: Rates) -> _Beginning | None:
        """Return that with some rates of the vehicle as it is in its file, if there is one."""
        driven = self._drive.known
        if driven is None or prepared is not driven.prepared:
            return None
        return next((each for each in self._beginnings if each.rates == rates), None)
