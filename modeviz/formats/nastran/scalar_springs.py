"""Scalar springs of a Nastran input file: CELAS1 and CELAS2."""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from modeviz.errors import VehicleError, listed, located
from modeviz.files.mount_tables.bushing import Bushing
from modeviz.formats.component import check_range
from modeviz.formats.nastran.bulk import Card
from modeviz.formats.nastran.bush_properties import BushProperties, BushRates
from modeviz.formats.nastran.grids import COINCIDENT, Grids


def scalar_springs(
    elements: Sequence[Card], grids: Grids, properties: BushProperties, note: Callable[[str], None]
) -> Iterator[Bushing]:
    """Yield the bushings of scalar springs; those of the same grids and loss factor are one.

    Args:
        elements: CELAS1 and CELAS2.
        grids: of the file.
        properties: with the PELAS.
        note: told which are left out, and which are taken to act elsewhere.

    Raises:
        VehicleError: a card is wrong, or joins two directions; the text names it.
    """
    lots: dict[tuple[int, int, float], list[tuple[str, int, float]]] = {}
    scalar, apart = [], []
    for card in elements:
        name = f"{card.name} {card.text(0)}"
        with located(name):
            if any(_is_scalar(card, i, grids) for i in (2, 4)):
                scalar.append(name)
                continue
            k, g = _rate(card, properties)
            first, second, direction, across = _ends(card, grids)
            lots.setdefault((first, second, g), []).append((card.text(0), direction, k))
            if across > COINCIDENT:
                apart.append(name)
    if scalar:
        note(f"{listed(scalar)}: hold on to scalar points, which no body has, and are left out")
    if apart:
        note(
            f"{listed(apart)}: the grids are apart across the direction; taken to act halfway, so that "
            "what turns as one is not resisted"
        )
    for (first, second, g), lot in lots.items():
        stiffness = np.zeros(6)
        for _, direction, k in lot:
            stiffness[direction] += k
        rates = BushRates(stiffness, np.zeros(6), np.full(6, g))
        name = f"CELAS {lot[0][0]}"
        yield grids.bushing(name, {"G1": first, "G2": second}, rates, grids.directions(first), g)


def _is_scalar(card: Card, field: int, grids: Grids) -> bool:
    """Whether an end, which begins at a field, is a scalar point."""
    number = card.whole(field, 0)
    return bool(number) and not card.whole(field + 1, 0) and not grids.has(number)


def _rate(card: Card, properties: BushProperties) -> tuple[float, float]:
    """Stiffness and loss factor."""
    if card.name == "CELAS1":
        k, g = properties.spring(card.whole(1, card.whole(0)))
    else:
        k, g = card.real(1), card.real(6)
    check_range("its K and GE", np.array([k, g]))
    if k < 0 or g < 0:
        raise VehicleError(f"found K {k:g} and GE {g:g}, expected zero or more")
    return k, g


def _ends(card: Card, grids: Grids) -> tuple[int, int, int, float]:
    """What a spring joins.

    Returns:
        The grids, the second zero if it is held; which of six directions of the first; and how far they
        are apart across it, which does not matter of one that turns.
    """
    ends = [(card.whole(i, 0), card.whole(i + 1, 0)) for i in (2, 4) if card.whole(i, 0)]
    if not ends:
        raise VehicleError("names no grid")
    for _, component in ends:
        if not 1 <= component <= 6:
            raise VehicleError(f"found the component {component}, expected 1 to 6")
    ways = [grids.directions(grid)[(component - 1) % 3] for grid, component in ends]
    first, component = ends[0]
    if len(ends) == 1:
        return first, 0, component - 1, 0.0
    second, other = ends[1]
    if (component > 3) != (other > 3) or not np.allclose(*ways, atol=1e-6):
        raise VehicleError(
            f"joins component {component} of grid {first} with {other} of grid {second}, which is "
            "another direction; expected the same"
        )
    apart = grids.place(second) - grids.place(first)
    across = np.linalg.norm(apart - (apart @ ways[0]) * ways[0]) if component <= 3 else 0.0
    return first, second, component - 1, float(across)
