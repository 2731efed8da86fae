"""The geometry of a Nastran input file."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.formats.component import CORNERS, ElementKind
from modeviz.formats.nastran.bulk import TOLD, Card, cards
from modeviz.formats.nastran.model import (
    CORNERS_OF,
    FRAME_CARDS,
    FrameCard,
    Model,
    ModesAsked,
    sorted_grids,
    weights_note,
)
from modeviz.formats.nastran.residual_vectors import modes_asked
from modeviz.formats.nastran.rigid_elements import NAMES as SET_CARDS
from modeviz.formats.nastran.rigid_elements import node_set
from modeviz.formats.node_sets import NodeSet
from modeviz.vehicle.arrays import Array

FRAMES = frozenset(f"CORD{n}{kind}" for n in "12" for kind in FRAME_CARDS)
NAMES = frozenset({"GRID", "GRDSET", "EIGRL", "EIGR", "PARAM", *FRAMES, *CORNERS_OF, *SET_CARDS})
"""The cards that are read."""

AFTER_ID = frozenset({"CONROD", "PLOTEL"})
"""Elements without a property: their grids follow their number."""

TWO_TO_A_CARD = frozenset({"PLOTEL"})
"""Elements of which a card may have a second beside the first."""


def read_deck(path: Path) -> Model:
    """Return the geometry of an input file and of those it includes.

    Raises:
        VehicleError: a file is missing, a card is wrong, or there is no GRID.
    """
    with located(path):
        found = GeometryCards()
        for card in cards(path, NAMES):
            found.add(card)
        return found.model()


@dataclass
class GeometryCards:
    """What cards say of the geometry, one after the other."""

    grids: list[Card] = field(default_factory=list)
    usual: Card = field(default_factory=lambda: Card("GRDSET", []))
    """What grids have where nothing stands in their fields."""
    frames: dict[int, FrameCard] = field(default_factory=dict)
    elements: dict[ElementKind, list[list[int]]] = field(default_factory=dict)
    norms: list[str] = field(default_factory=list)
    asked: list[ModesAsked] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    node_sets: dict[str, NodeSet] = field(default_factory=dict)

    def add(self, card: Card) -> None:
        """Take in one of `NAMES`, or what is told; raises VehicleError if it is wrong."""
        if card.name == TOLD:
            self.notes.append(card.text(0))
        elif card.name == "GRID":
            self.grids.append(card)
        elif card.name == "GRDSET":
            self.usual = card
        elif card.name in FRAMES:
            self.frames.update(_frames(card))
        elif card.name in ("EIGRL", "EIGR"):
            self.norms.append(_norm(card))
            self.asked.append(modes_asked(card))
        elif card.name == "PARAM":
            self.notes += _parameter(card)
        elif card.name in SET_CARDS:
            self.node_sets.update(filter(None, [node_set(card)]))
        else:
            self.elements.setdefault(CORNERS_OF[card.name], []).extend(_corners(card))

    def model(self) -> Model:
        """Return the geometry; raises VehicleError if there is no GRID, or one is wrong."""
        if not self.grids:
            raise VehicleError("found no GRID, so it has no geometry; is it the whole input?")
        ids = np.array([card.whole(0) for card in self.grids], np.int64)
        usual = self.usual.whole(1, 0), self.usual.whole(5, 0)
        systems = np.array(
            [(card.whole(1, usual[0]), card.whole(5, usual[1])) for card in self.grids], np.int64
        )
        coordinates = np.array([[card.real(i) for i in (2, 3, 4)] for card in self.grids])
        return Model(
            *sorted_grids(ids, systems, coordinates),
            self.frames,
            {kind: _rows(kind, corners) for kind, corners in self.elements.items() if corners},
            is_mass_normalised=bool(self.norms) and set(self.norms) == {"MASS"},
            notes=tuple(self.notes),
            asked=tuple(self.asked),
            node_sets=self.node_sets,
        )


def _rows(kind: ElementKind, corners: list[list[int]]) -> Array:
    return np.array(corners, np.int64).reshape(-1, CORNERS[kind])


def _corners(card: Card) -> Iterator[list[int]]:
    """The grids at corners of the card's elements; none of one that is tied to nothing at an end."""
    n_corners = CORNERS[CORNERS_OF[card.name]]
    for start in (0, 4) if card.name in TWO_TO_A_CARD else (0,):
        first = start + (1 if card.name in AFTER_ID else 2)
        corners = [card.whole(first + i, 0) for i in range(n_corners)]
        if all(corners):
            yield corners


def _frames(card: Card) -> Iterator[tuple[int, FrameCard]]:
    kind = FRAME_CARDS[card.name[-1]]
    if card.name[4] == "2":
        points = np.array([card.real(2 + i) for i in range(9)]).reshape(3, 3)
        yield card.whole(0), FrameCard(kind, card.whole(1, 0), points)
        return
    for start in (0, 4):  # two to a card
        if card.text(start):
            grids = tuple(card.whole(start + i) for i in (1, 2, 3))
            yield card.whole(start), FrameCard(kind, 0, grids=grids)


def _norm(card: Card) -> str:
    """By what modes are normalised: MASS, unless the card says otherwise."""
    texts = [field.upper() for field in card.fields[6 if card.name == "EIGRL" else 8 :]]
    return next((t for t in texts if t in ("MASS", "MAX", "POINT", "AF")), "MASS")


def _parameter(card: Card) -> Iterator[str]:
    """A sentence if masses are given as weights."""
    if card.text(0).upper() == "WTMASS" and card.real(1) != 1:
        yield weights_note(f"{card.real(1):.6g}")
