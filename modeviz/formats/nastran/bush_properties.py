"""Properties of Nastran's springs: PBUSH, PBUSHT with its tables, and PELAS, in the file's units.

After MSC Nastran's Quick Reference Guide. Of a PBUSH the K values are nominal; a PBUSHT has tables of
them over frequency, which hold in frequency responses.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError, listed, located, quoted
from modeviz.files.mount_tables.bushing import DIRECTIONS
from modeviz.formats.component import check_range
from modeviz.formats.nastran.bulk import Card
from modeviz.vehicle.arrays import Floats

NAMES = frozenset({"PBUSH", "PBUSHT", "TABLED1", "PELAS"})

LEFT_OUT = {"RCV", "M", "T", "V"}
"""Lines of a PBUSH that are no rates: stress recovery, mass."""


@dataclass(frozen=True, eq=False)
class BushRates:
    """What a property says, in the file's units."""

    stiffness: Floats
    """(6,)."""
    damping: Floats
    """(6,)."""
    loss_factors: Floats
    """(6,)."""
    rigid: tuple[str, ...] = ()
    """Which of `DIRECTIONS` are stiff without measure."""


class BushProperties:
    """The properties of a file.

    Args:
        cards: of the file, of `NAMES`.
        frequency: Hz, at which rates over frequency are taken; None: the nominal ones are.
        note: told what is taken how.

    Raises:
        VehicleError: a card is there twice.
    """

    def __init__(self, cards: list[Card], frequency: float | None, note: Callable[[str], None]) -> None:
        self._nominal = _by_number(cards, "PBUSH")
        self._over_frequency = _by_number(cards, "PBUSHT")
        self._tables = _by_number(cards, "TABLED1")
        self._springs = dict(_springs(cards))
        self._frequency = frequency
        self._note = note
        self._known: dict[int, BushRates] = {}

    def bush(self, number: int) -> BushRates:
        """Return the rates of a PBUSH.

        Raises:
            VehicleError: it is not there, or says what is not read.
        """
        if number not in self._known:
            if number not in self._nominal:
                raise VehicleError(
                    f"property {number}: is no PBUSH of the file; there are {listed(self._nominal)}"
                )
            with located(f"PBUSH {number}"):
                self._known[number] = self._bush(self._nominal[number])
        return self._known[number]

    @property
    def depend_on_frequency(self) -> bool:
        """Whether those that were asked for have rates over frequency."""
        return not self._known.keys().isdisjoint(self._over_frequency)

    def spring(self, number: int) -> tuple[float, float]:
        """Return stiffness and loss factor of a PELAS; raises VehicleError if it is not there."""
        if number not in self._springs:
            raise VehicleError(f"property {number}: is no PELAS of the file")
        return self._springs[number]

    def _bush(self, card: Card) -> BushRates:
        found = {flag: card.fields[at : at + 6] for flag, at in _lines(card)}
        if left := sorted(found.keys() & LEFT_OUT - {"RCV"}):
            said = ", ".join(f"{flag} {' '.join(filter(None, found[flag]))}" for flag in left)
            self._note(f"PBUSH {card.text(0)}: {said}: masses and the like are left out")
        for flag, at in _lines(card):
            if flag not in {"K", "B", "GE", *LEFT_OUT}:
                raise VehicleError(
                    f"{_found_at(card, at)}, expected lines K, B, GE, M or RCV with their letters in "
                    "field 3"
                )
        k, b, ge = (found.get(flag, [""] * 6) for flag in ("K", "B", "GE"))
        rigid = tuple(d for d, text in zip(DIRECTIONS, k, strict=True) if text.upper() == "RIGID")
        k = ["" if text.upper() == "RIGID" else text for text in k]
        if ge[0] and not any(ge[1:]):
            ge = [ge[0]] * 6
        values = {flag: _numbers(card, texts) for flag, texts in (("K", k), ("B", b), ("GE", ge))}
        self._at_frequency(card.text(0), values)
        for flag, numbers in values.items():
            if (numbers < 0).any():
                i = int(np.argmin(numbers))
                raise VehicleError(f"{flag}{i + 1}: found {numbers[i]:g}, expected zero or more")
        return BushRates(values["K"], values["B"], values["GE"], rigid)

    def _at_frequency(self, number: str, values: dict[str, Floats]) -> None:
        """Puts what a PBUSHT says at the frequency in place of nominal values."""
        card = self._over_frequency.get(int(number))
        if card is None:
            return
        if self._frequency is None:
            self._note(
                f"PBUSH {number}: its rates depend on frequency; the nominal ones are taken, or give "
                "--frequency"
            )
            return
        with located("PBUSHT"):
            for flag, at in _lines(card):
                if flag == "KN":
                    continue  # for nonlinear solutions
                if flag not in values:
                    raise VehicleError(f"{_found_at(card, at)}, expected lines K, B, GE or KN")
                tables = [card.whole(i, 0) if card.text(i) else 0 for i in range(at, at + 6)]
                if flag == "GE" and not any(tables[1:]):
                    tables = [tables[0]] * 6
                for i, table in enumerate(tables):
                    if table:
                        values[flag][i] = self._table(table, self._frequency)
        self._note(f"PBUSH {number}: its rates are those at {self._frequency:g} Hz")

    def _table(self, number: int, x: float) -> float:
        """The value of a TABLED1."""
        if number not in self._tables:
            raise VehicleError(f"table {number}: is no TABLED1 of the file")
        card = self._tables[number]
        with located(f"TABLED1 {number}"):
            points = np.array(list(_points(card)))
            check_range("its points", points)
            if len(points) < 2 or (np.diff(points[:, 0]) < 0).any():
                raise VehicleError("expected two or more points of rising frequencies")
            first, last = points[0, 0], points[-1, 0]
            if not first <= x <= last:
                raise VehicleError(f"is from {first:g} to {last:g} Hz, and --frequency is {x:g}")
            is_log = [card.text(i).upper() == "LOG" for i in (1, 2)]
            for i, log in enumerate(is_log):
                if log and (points[:, i] <= 0).any():
                    raise VehicleError("has a logarithmic axis with values that are not above zero")
                points[:, i] = np.log(points[:, i]) if log else points[:, i]
            value = float(np.interp(np.log(x) if is_log[0] else x, *points.T))
            return float(np.exp(value)) if is_log[1] else value


def _by_number(cards: list[Card], name: str) -> dict[int, Card]:
    found: dict[int, Card] = {}
    for card in cards:
        if card.name == name:
            number = card.whole(0)
            if number in found and found[number] != card:
                raise VehicleError(f"{name} {number}: is there twice, and not alike")
            found[number] = card
    return found


def _lines(card: Card) -> Iterator[tuple[str, int]]:
    """Where the six values of each line of a card begin, by the flag before them.

    Raises:
        VehicleError: a flag is there twice, or none before values.
    """
    seen = set()
    for at in range(0, len(card.fields), 8):
        flag = card.text(at + 1).upper()
        if not flag and any(card.fields[at + 2 : at + 8]):
            raise VehicleError(
                f"found values {listed(card.fields[at + 2 : at + 8])} without K, B or GE"
            )
        if flag in seen:
            raise VehicleError(f"{flag} is there twice")
        seen.add(flag)
        if flag:
            yield flag, at + 2


def _found_at(card: Card, at: int) -> str:
    """What stands in place of the flag before the six values that begin there, and on which line."""
    before, flag = card.text(at - 2), card.text(at - 1)
    early = f" after {quoted(before)}, which is a field early" if at > 2 and before else ""
    return f"line {at // 8 + 1} of the card: found {quoted(flag)}{early}"


def _numbers(card: Card, texts: list[str]) -> Floats:
    numbers = np.array([Card(f"{card.name} {card.text(0)}", ["", text]).real(1) for text in texts])
    check_range("its rates", numbers)
    return numbers


def _points(card: Card) -> Iterator[tuple[float, float]]:
    """The points of a table."""
    for at in range(8, len(card.fields) - 1, 2):
        x, y = card.text(at).upper(), card.text(at + 1).upper()
        if "ENDT" in (x, y):
            return
        if "SKIP" not in (x, y) and (x or y):
            yield card.real(at), card.real(at + 1)


def _springs(cards: list[Card]) -> Iterator[tuple[int, tuple[float, float]]]:
    """Stiffness and loss factor of each PELAS, two to a card."""
    for card in cards:
        if card.name == "PELAS":
            for at in (0, 4):
                if card.text(at):
                    yield card.whole(at), (card.real(at + 1), card.real(at + 2))


def one_loss_factor(rates: BushRates, note: Callable[[str], None]) -> float:
    """Return the loss factor of a bushing whose directions may have different ones.

    Where they differ it is their mean along the axes, weighted by stiffness, and `note` is told.
    """
    k, g = rates.stiffness, rates.loss_factors
    stiff = k > 0
    if not stiff.any():
        return 0.0
    if np.ptp(g[stiff]) <= 1e-9 * g.max():
        return float(g[stiff][0])
    those, where = (slice(0, 3), "along") if stiff[:3].any() else (slice(3, 6), "about")
    mean = float(k[those] @ g[those] / k[those].sum())
    note(
        f"its loss factors differ by direction, {g[stiff].min():g} to {g[stiff].max():g}; taken as "
        f"{mean:.4g}, their mean {where} the axes weighted by stiffness"
    )
    return mean
