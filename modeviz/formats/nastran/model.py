"""The geometry of a Nastran model, of whichever file it comes: grids, coordinate systems, elements."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from modeviz.errors import VehicleError, listed
from modeviz.formats.component import ElementKind, check_range
from modeviz.formats.frames import BASIC, Frame, FrameKind, frame_of_points
from modeviz.formats.node_sets import NodeSet
from modeviz.vehicle.arrays import Array, Floats

CORNERS_OF: Mapping[str, ElementKind] = {
    "CROD": "line", "CONROD": "line", "CTUBE": "line", "CBAR": "line", "CBEAM": "line", "CBEND": "line",
    "CBEAM3": "line", "CBUSH": "line", "CBUSH1D": "line", "CVISC": "line", "PLOTEL": "line",
    "CTRIA3": "triangle", "CTRIA6": "triangle", "CTRIAR": "triangle",
    "CQUAD4": "quad", "CQUAD8": "quad", "CQUADR": "quad", "CQUAD": "quad", "CSHEAR": "quad",
    "CTETRA": "tetra", "CPYRAM": "pyramid", "CPENTA": "wedge", "CHEXA": "hexa",
    "CPENTAL": "wedge", "CHEXAL": "hexa", "CPLSTN3": "triangle", "CPLSTN6": "triangle",
    "CPLSTN4": "quad", "CPLSTN8": "quad", "CPLSTS3": "triangle", "CPLSTS6": "triangle",
    "CPLSTS4": "quad", "CPLSTS8": "quad",
}  # fmt: skip
"""The elements that are drawn, and what they are."""

FRAME_CARDS: Mapping[str, FrameKind] = {"R": "rectangular", "C": "cylindrical", "S": "spherical"}
"""By the last letter of CORD1R and of its like."""


@dataclass(frozen=True, eq=False)
class FrameCard:
    """A coordinate system as its card has it: by three points in another, or by three grids."""

    kind: FrameKind
    reference: int
    points: Floats | None = None
    """(3, 3): the origin, a point on the z axis, one in the xz plane."""
    grids: tuple[int, ...] = ()
    """Instead of points."""

    def __post_init__(self) -> None:
        if self.points is not None:
            check_range("the points of a coordinate system", self.points)


@dataclass(frozen=True)
class ModesAsked:
    """The modes that a card of an input file asks for."""

    n_modes: int = 0
    """0: as many as there are."""
    top_hz: float = 0.0
    """Of the range; 0: it has no end."""


@dataclass(frozen=True, eq=False)
class Model:
    """What is known of a model's geometry."""

    ids: Array
    """(n,), of the grids, rising."""
    systems: Array
    """(n, 2): the system of each grid's coordinates and that of its motions."""
    coordinates: Floats
    """(n, 3)."""
    frames: Mapping[int, FrameCard]
    elements: Mapping[ElementKind, Array]
    """By kind (n_elements, n_corners), ids of grids."""
    is_mass_normalised: bool = False
    """Whether the modes are asked for with a modal mass of one."""
    notes: tuple[str, ...] = field(default=())
    asked: tuple[ModesAsked, ...] = ()
    """How many modes are asked for, by each card that asks."""
    node_sets: Mapping[str, NodeSet] = field(default_factory=dict)
    """Sets of grids that carry a point, by name: "RBE2:901"."""


def sorted_grids(ids: Array, systems: Array, coordinates: Floats) -> tuple[Array, Array, Floats]:
    """Return grids by rising ids, those once that are there twice alike.

    Raises:
        VehicleError: two of an id differ.
    """
    order = np.argsort(ids, kind="stable")
    ids, systems, coordinates = ids[order], systems[order], coordinates[order]
    again = np.flatnonzero(ids[1:] == ids[:-1]) + 1
    differs = (coordinates[again] != coordinates[again - 1]).any(axis=1)
    differs |= (systems[again] != systems[again - 1]).any(axis=1)
    if differs.any():
        raise VehicleError(f"GRID {ids[again[differs][0]]}: is there twice, and not alike")
    kept = np.delete(np.arange(len(ids)), again)
    check_range("the coordinates of grids", coordinates)
    return ids[kept], systems[kept], coordinates[kept]


def basic_geometry(model: Model) -> tuple[Floats, dict[int, Frame]]:
    """Return where the grids are in the basic system, (n, 3), and all coordinate systems in it.

    Systems may be given in others, or by grids, whose places may be given in others.

    Raises:
        VehicleError: one is missing, or depends on itself.
    """
    frames: dict[int, Frame] = {0: BASIC}
    places = np.full((len(model.ids), 3), np.nan)
    waiting = dict(model.frames)
    fresh = [0]
    while fresh:
        for number in fresh:
            those = model.systems[:, 0] == number
            places[those] = frames[number].places(model.coordinates[those])
        fresh = []
        for number, card in list(waiting.items()):
            points = _basic_points(model, card, frames, places)
            if points is not None:
                try:
                    frames[number] = frame_of_points(card.kind, *points)
                except VehicleError as error:
                    raise VehicleError(f"coordinate system {number}: {error}") from None
                del waiting[number]
                fresh.append(number)
    named = {int(n) for n in np.unique(model.systems) if n > 0}
    missing = sorted((named | waiting.keys()) - frames.keys())
    if missing:
        raise VehicleError(
            f"coordinate systems {listed(missing)}: are named but not there, or are given by what is "
            "given in them"
        )
    return places, frames


def _basic_points(
    model: Model, card: FrameCard, frames: Mapping[int, Frame], places: Floats
) -> Floats | None:
    """The three points of a system in the basic one; None if they are not known yet."""
    if card.points is not None:
        reference = frames.get(card.reference)
        return None if reference is None else reference.places(card.points)
    rows = np.searchsorted(model.ids, card.grids)
    if (rows == len(model.ids)).any() or model.ids[rows].tolist() != list(card.grids):
        raise VehicleError(
            f"a coordinate system is given by grids {listed(card.grids)}, one is missing"
        )
    points = places[rows]
    return points if np.isfinite(points).all() else None


def grouped(elements: Mapping[ElementKind, Sequence[Array]]) -> dict[ElementKind, Array]:
    """Return the corners of elements by kind, of several lots of each."""
    return {kind: np.concatenate(lots) for kind, lots in elements.items() if lots}


def weights_note(value: str) -> str:
    """Return what there is to know of a model whose PARAM,WTMASS has a value other than one."""
    return (
        f"PARAM,WTMASS is {value}: its masses are given otherwise than modal masses, which are in the "
        "units of force, length and seconds; --units are those"
    )


def unread_note(card: str) -> str:
    """Return what there is to know of elements that are written as by no version known."""
    return f"its {card} elements are written as by no version known, and are not drawn"
