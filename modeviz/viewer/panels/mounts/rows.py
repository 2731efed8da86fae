"""A mount rate on the page: a slider from soft to stiff, and a box with the number."""

import math

import viser

from modeviz.errors import ModevizError
from modeviz.files.schema.scaling import written
from modeviz.report.rate_fields import direction, quantity, spoken
from modeviz.text.wording import MINUS, in_a_box, sentence_case, signed
from modeviz.units import QuantityName, factor
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import Rates
from modeviz.viewer.page.binding import Binding
from modeviz.viewer.page.widgets.handles import assign, mark
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.panels.mounts.travel import Travel, travel
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.design import STIFFEST, known_sets
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State, compared_rates

DECIMALS = 6
"""That a box shows at most."""

MANY_TIMES = 10.0
"""From here on a change is a factor, and no percentage."""


class RateRow:
    """One rate of a mount group, bound to a session's state."""

    def __init__(
        self, gui: viser.GuiApi, session: Session, group: MountGroup, field: str, write_back: WriteBack
    ) -> None:
        """Builds slider and box.

        Args:
            gui: where.
            session: what they change.
            group: whose rate.
            field: which, one of the group's own.
            write_back: of all rates of the group.
        """
        self._session, self._group, self._field = session, group, field
        self._quantity: QuantityName = quantity(field)
        self._direction = direction(field)
        self._travel = self._widest_travel()
        self._slider = gui.add_slider(
            sentence_case(self._direction),
            min=0,
            max=self._travel.length,
            step=1,
            initial_value=self._position(session.state),
            marks=(),
        )
        shown = self._unit(session.state), self._in_unit(session.state)
        self._number = gui.add_number(*shown, step=1.0)
        assign(self._number, precision=DECIMALS)
        self.bindings: tuple[Binding[State], ...] = (
            Binding(self._slider, session, self._position, self._slide, write_back),
            Binding(self._number, session, self._in_unit, self._type, write_back, typed=True),
        )

    def hold(self, group: MountGroup) -> None:
        """Has the bounds of a group of its name, if they are others."""
        self._group = group
        self._travel = self._widest_travel()
        assign(self._slider, max=self._travel.length)

    def show(self, state: State, compared: Rates, effect: str) -> None:
        """Marks what was changed and what is locked.

        Args:
            state: what is shown.
            compared: the rates compared with.
            effect: what a change of this rate does, a sentence or nothing.
        """
        base, unit = self._rate_in(compared), self._unit(state)
        before = state.against if self._group.name in compared else "As it was added"
        is_locked = (self._group.name, self._field) in state.design.locked
        in_unit = written(base, factor(unit, self._quantity))
        about = f"{self._group.title}, {self._called}, {unit}. {before}: {in_unit:g}."
        locked = " Locked: loading a set is all that moves it." if is_locked else ""
        assign(
            self._slider,
            label=row_label(self._direction, self._rate_in(state.design.rates), base),
            hint=f"{about} {effect}{locked}",
            disabled=is_locked,
        )
        mark(self._slider, self._travel.position(base) if self._travel.has(base) else None)
        assign(
            self._number,
            label=unit,
            hint=f"{about} Any rate from zero, which is none at all.{locked}",
            disabled=is_locked,
            step=step_of_box(in_unit),
        )

    def _widest_travel(self) -> Travel:
        """From bound to bound, with every set the vehicle comes with and the first rate between."""
        known = [*known_sets(self._session.vehicle).values(), self._session.state.design.rates]
        softest, stiffest = (getattr(bound, self._field) for bound in self._group.bounds)
        return travel(softest, stiffest, [self._rate_in(rates) for rates in known])

    def _rate_in(self, rates: Rates) -> float:
        return getattr(rates.get(self._group.name, self._group.rates), self._field)

    def _position(self, state: State) -> int:
        return self._travel.position(self._rate_in(state.design.rates))

    def _unit(self, state: State) -> str:
        return state.units[self._quantity]

    def _in_unit(self, state: State) -> float:
        rate = self._rate_in(state.design.rates)
        return in_a_box(written(rate, factor(self._unit(state), self._quantity)))

    @property
    def _called(self) -> str:
        """Which rate it is, and at which frequency if it depends on that."""
        called, dynamic = f"{spoken(self._field)} rate", self._group.dynamic
        if dynamic is None or self._quantity != "stiffness":
            return called
        return f"{called} at {dynamic.reference_hz:g} Hz, which scales those at all others"

    def _slide(self, position: int) -> None:
        compared = compared_rates(self._session.vehicle, self._session.state)
        rate = self._travel.rate(position, self._rate_in(compared))
        self._session.do(SetRate(self._group.name, self._field, rate))

    def _type(self, value: float) -> None:
        unit = self._unit(self._session.state)
        per_unit = factor(unit, self._quantity)
        if value == self._in_unit(self._session.state):
            return  # what the box shows of a rate with more digits
        if not 0 <= value * per_unit <= STIFFEST:
            found = f"{value:g}".replace("-", MINUS)
            raise ModevizError(
                f"{self._group.name} {spoken(self._field)}: found {found} {unit}, "
                f"expected 0 to {STIFFEST / per_unit:.0f} {unit}"
            )
        self._session.do(SetRate(self._group.name, self._field, value * per_unit))


def row_label(direction: str, now: float, base: float) -> str:
    """A direction, and the change of its rate against another where there is one."""
    return f"{sentence_case(direction)}  {change_in_words(now, base)}".strip()


def change_in_words(now: float, base: float) -> str:
    """A change of a rate, as short as it is clear: "+50 %", "× 12", "added" to none; or nothing."""
    if now == base:
        return ""
    if base == 0:
        return "added"
    ratio = now / base
    if ratio >= MANY_TIMES:
        return f"× {ratio:.0f}"
    percent = 100 * (ratio - 1)
    return signed(percent, 0 if abs(percent) >= 1 else 1, " %")


def step_of_box(rate: float) -> float:
    """Return the step of an arrow key: the power of ten next below two percent of a rate."""
    return 10.0 ** math.floor(math.log10(rate / 50)) if rate > 0 else 1.0
