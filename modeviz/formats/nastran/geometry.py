"""The geometry of a model as a component that has no modes."""

from collections.abc import Mapping, Sequence

import numpy as np

from modeviz.formats.component import Component, ElementKind, Modes, rows_of
from modeviz.formats.frames import Frame
from modeviz.formats.nastran.model import Model
from modeviz.vehicle.arrays import Array, Floats


def without_modes(
    model: Model, places: Floats, frames: Mapping[int, Frame], notes: Sequence[str] = ()
) -> Component:
    """Return the geometry of a model, with notes on what it lacks; places and frames are basic."""
    none = np.zeros(0)
    modes = Modes(none, none, none, np.zeros((len(model.ids), 6, 0)))
    elements: dict[ElementKind, Array] = {
        kind: rows_of(model.ids, corners) for kind, corners in model.elements.items()
    }
    return Component(
        model.ids,
        places,
        elements,
        modes,
        notes=once(model.notes, notes),
        node_sets=model.node_sets,
        axes=_axes(model, places, frames),
    )


def _axes(model: Model, places: Floats, frames: Mapping[int, Frame]) -> Floats | None:
    """The directions of the grids' own motions; none if all are those of the basic system."""
    systems = model.systems[:, 1]
    if not (systems > 0).any():
        return None
    axes = np.tile(np.eye(3), (len(systems), 1, 1))
    for number in np.unique(systems[systems > 0]).tolist():
        axes[systems == number] = frames[number].directions(places[systems == number])
    return axes


def once(*notes: Sequence[str]) -> tuple[str, ...]:
    """Return all notes in order; the input file and the results may say the same."""
    return tuple(dict.fromkeys(note for some in notes for note in some))
