"""Springs and bushings of a Nastran input file: CBUSH, CELAS1 and CELAS2."""

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.mount_tables.bushing import Bushing
from modeviz.formats.component import UnitSystem, check_range
from modeviz.formats.nastran.bulk import TOLD, Card, cards
from modeviz.formats.nastran.bush_properties import NAMES as PROPERTIES
from modeviz.formats.nastran.bush_properties import BushProperties, BushRates, one_loss_factor
from modeviz.formats.nastran.deck import read_deck
from modeviz.formats.nastran.grids import COINCIDENT, Grids
from modeviz.formats.nastran.scalar_springs import scalar_springs
from modeviz.vehicle.arrays import Floats

ELEMENTS = frozenset({"CBUSH", "CELAS1", "CELAS2"})
PASSED_OVER = frozenset(
    {"CBUSH1D", "CBUSH2D", "CELAS3", "CELAS4", "CDAMP1", "CDAMP2", "CDAMP3", "CDAMP4", "CVISC", "CGAP"}
)
"""Elements between bodies that are not read, which is told."""

ALL_DIRECTIONS = frozenset("123456")

MATRICES = frozenset({"DMIG"})


def has_bushings(path: Path) -> bool:
    """Return whether an input file has springs between bodies, and no matrices of a body."""
    with located(path.name):
        names = {card.name for card in cards(path, ELEMENTS | MATRICES)}
    return bool(names & ELEMENTS) and not names & MATRICES


def read_bushings(
    path: Path,
    units: UnitSystem,
    frequency: float | None,
    bodies: tuple[str, ...],
    note: Callable[[str], None],
) -> tuple[Bushing, ...]:
    """Return the bushings of an input file; those of one PBUSH are a group.

    Args:
        path: of the file.
        units: that it is in.
        frequency: Hz, at which rates over frequency are taken; None: nominal ones are.
        bodies: of the first and the second grids; none: those with attachments of the grids' numbers,
            or else at their places.
        note: told what is left out or taken otherwise.

    Raises:
        VehicleError: a card is wrong or missing; the text names it.
    """
    model = read_deck(path)
    with located(path.name):
        every, held = _cards(path)
        if left := Counter(card.name for card in every if card.name in PASSED_OVER):
            note(f"{', '.join(f'{n} {name}' for name, n in left.items())} are left out")
        for card in every:
            if card.name == TOLD:
                note(card.text(0))
        elements = [card for card in every if card.name in ELEMENTS]
        _check_numbers(elements)
        properties = BushProperties(every, frequency, note)
        grids = Grids.of(model, units, bodies, held)
        bushes = [_bush(card, grids, properties, note) for card in elements if card.name == "CBUSH"]
        scalar = [card for card in elements if card.name != "CBUSH"]
        springs = tuple(scalar_springs(scalar, grids, properties, note))
        if frequency is not None and not properties.depend_on_frequency:
            raise VehicleError("--frequency: none of its rates depend on frequency; leave it out")
        return (*bushes, *springs)


def _cards(path: Path) -> tuple[list[Card], frozenset[int]]:
    """The cards of springs, and the grids that are held in all directions where they are given."""
    every, held, unsaid, usual = [], [], [], ""
    for card in cards(path, ELEMENTS | PASSED_OVER | PROPERTIES | {"GRID", "GRDSET"}):
        if card.name == "GRDSET":
            usual = card.text(6)
        elif card.name != "GRID":
            every.append(card)
        elif not card.text(6):
            unsaid.append(card.whole(0))
        elif ALL_DIRECTIONS.issubset(card.text(6)):
            held.append(card.whole(0))
    return every, frozenset(held + unsaid if ALL_DIRECTIONS.issubset(usual) else held)


def _check_numbers(elements: list[Card]) -> None:
    """Raises VehicleError for a number that two elements have."""
    counts = Counter(card.whole(0) for card in elements)
    number, count = counts.most_common(1)[0] if counts else (0, 0)
    if count > 1:
        raise VehicleError(f"element {number}: is there {count} times; each needs its own number")


def _bush(card: Card, grids: Grids, properties: BushProperties, note: Callable[[str], None]) -> Bushing:
    """The bushing of a CBUSH."""
    name = f"CBUSH {card.text(0)}"
    with located(name):
        first, second = card.whole(2), card.whole(3, 0)
        number = card.whole(1, card.whole(0))
        rates = properties.bush(number)
        fraction = card.real(8) if card.text(8) else 0.5
        if not 0 <= fraction <= 1:
            raise VehicleError(f"S: found {fraction:g}, expected 0 to 1")
        loss_factor = one_loss_factor(rates, lambda text: note(f"{name}: {text}"))
        axes = _orientation(card, grids, grids.place(first), grids.place(second or first), rates)
        bushing = grids.bushing(name, {"GA": first, "GB": second}, rates, axes, loss_factor)
        return replace(
            bushing, group=f"PBUSH {number}", elastic_center=fraction, acts_at=_offset(card, grids)
        )


def _offset(card: Card, grids: Grids) -> Floats | None:
    """Where a bush acts that is not on the line between its grids, m: so far from the first of them."""
    system = card.whole(9, -1)
    if system < 0:
        return None
    place = grids.place(card.whole(2))
    offset = _vector(card, 10)
    return (place + offset @ grids.axes(system, place)) * grids.units.length


def _orientation(card: Card, grids: Grids, a: Floats, b: Floats, rates: BushRates) -> Floats:
    """The axes of a CBUSH as rows, (3, 3): those of CID, or else along its grids and by GO or X.

    Raises:
        VehicleError: it has none, and rates across the line between its grids.
    """
    if card.text(7):
        return grids.axes(card.whole(7), a)
    line = b - a
    if np.linalg.norm(line) < COINCIDENT:
        raise VehicleError("its grids are in one place, or the second is the ground; expected a CID")
    x = line / np.linalg.norm(line)
    if any(card.fields[4:7]):
        v = _in_plane(card, grids, a)
    elif _is_along(rates):
        v = np.eye(3)[int(np.argmin(np.abs(x)))]
    else:
        raise VehicleError("has rates across its line; expected GO, X1, X2 and X3, or CID")
    z = np.cross(x, v)
    if not np.linalg.norm(z) > 1e-6 * np.linalg.norm(v):
        raise VehicleError("its GO or X1, X2, X3 is along its line, expected across")
    z /= np.linalg.norm(z)
    return np.array([x, np.cross(z, x), z])


def _is_along(rates: BushRates) -> bool:
    """Whether a bush has rates along and about its x alone."""
    across = [1, 2, 4, 5]
    is_rigid = bool(set(rates.rigid) - {"x", "rx"})
    return not (rates.stiffness[across].any() or rates.damping[across].any() or is_rigid)


def _in_plane(card: Card, grids: Grids, a: Floats) -> Floats:
    """The vector that lies in the xy plane of a CBUSH: to GO, or X in the system of its first grid."""
    if card.text(4).isdigit() and not card.text(5) and not card.text(6):
        return grids.place(card.whole(4)) - a
    return _vector(card, 4) @ grids.directions(card.whole(2))


def _vector(card: Card, first: int) -> Floats:
    """Three fields as a vector; raises VehicleError for numbers that nobody has."""
    vector = np.array([card.real(i) for i in range(first, first + 3)])
    check_range("its vectors", vector)
    return vector
