"""Sets of grids out of a Nastran input file: rigid and averaging elements, and lists.

After MSC Nastran's Quick Reference Guide, "RBE2", "RBE3" and "SET1".
"""

from collections.abc import Iterator

from modeviz.errors import VehicleError
from modeviz.formats.nastran.bulk import Card
from modeviz.formats.node_sets import NodeSet

NAMES = frozenset({"RBE2", "RBE3", "SET1"})
"""The cards that are read."""

TRANSLATIONS, ALL = "123", "123456"
"""The directions in which the nodes of sets are joined; what joins fewer carries no point."""

MOST_IN_LIST = 1_000_000
"""Grids of a list."""


def node_set(card: Card) -> tuple[str, NodeSet] | None:
    """Return the name and the set of a card; None if it joins its grids in some directions only.

    Raises:
        VehicleError: the card is wrong.
    """
    name = f"{card.name}:{card.whole(0)}"
    if card.name == "RBE2":
        grids = [card.whole(i) for i in range(3, len(card.fields)) if card.text(i) and _is_id(card, i)]
        joined = card.text(2) in (TRANSLATIONS, ALL) and grids
        center = card.whole(1)
        return (name, NodeSet("rigid", _unique(center, *grids), center=center)) if joined else None
    if card.name == "SET1":
        grids = tuple(_listed_grids(card))
        return (name, NodeSet("mean", _unique(*grids))) if grids else None
    weights = _weights(card)
    if not weights or any(directions not in (TRANSLATIONS, ALL) for _, directions in weights.values()):
        return None
    carried = {grid: weight for grid, (weight, _) in weights.items()}
    return name, NodeSet("mean", tuple(carried), tuple(carried.values()), card.whole(2))


def _unique(*grids: int) -> tuple[int, ...]:
    return tuple(dict.fromkeys(grids))


def _is_id(card: Card, number: int) -> bool:
    """Whether a field is a grid, and not the coefficient of expansion that may end a card."""
    return card.text(number).isdecimal()


def _listed_grids(card: Card) -> Iterator[int]:
    """The grids of a list, in which "1 THRU 5" stands for five."""
    first = 0
    thru = False
    for number in range(1, len(card.fields)):
        text = card.text(number).upper()
        if text == "THRU":
            thru = True
        elif text.isdecimal():
            last = int(text)
            if thru and not 0 < last - first < MOST_IN_LIST:
                raise VehicleError(f"{card.name} {card.text(0)}: found {first} THRU {last}")
            yield from range(first + 1, last + 1) if thru else [last]
            first, thru = last, False


def _weights(card: Card) -> dict[int, tuple[float, str]]:
    """The weight and the directions of every grid of an averaging element."""
    weights: dict[int, tuple[float, str]] = {}
    weight, directions = 0.0, ""
    for number in range(4, len(card.fields)):
        text = card.text(number)
        if text.isalpha():  # UM and ALPHA end the grids
            break
        if text and not text.isdecimal():
            weight, directions = card.real(number), ""
        elif text and not directions:
            directions = text
        elif text and weight > 0:
            weights[int(text)] = weight, "".join(sorted(directions))
    return weights
