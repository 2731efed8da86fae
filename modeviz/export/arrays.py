"""Modes as NumPy's .npz: of a vehicle, and of a body as a vehicle folder has it."""

from dataclasses import replace

import numpy as np

from modeviz.export.axes import FileAxes
from modeviz.export.points import Points
from modeviz.export.shapes import ShapeSet
from modeviz.files.modal import arrays_file, body_arrays
from modeviz.vehicle.bodies import FlexibleBody

UNITS = "m, Hz, rad/s; shapes mass-normalised: 1/sqrt(kg), rotations rad/(m sqrt(kg))"


def modes_arrays(points: Points, shapes: ShapeSet, axes: FileAxes) -> bytes:
    """Return an .npz file of the modes of a vehicle on its points.

    Its arrays: `frequency_hz` and `damping_ratio` (n_modes,), `mode_numbers` and `mode_names`; `nodes`
    (n_nodes, 3), `node_bodies`, whose each is, and `node_names`, what it is; `triangles` and `lines`,
    rows of nodes; `shapes` (n_nodes, 6, n_modes): x, y, z, rx, ry, rz; of modes with their damping
    complex, and their `eigenvalue` and `modal_a`; `units` and `axes` in words.

    Args:
        points: what moves.
        shapes: the modes.
        axes: in which it is written.
    """
    bodies = [part.body for part in points.parts for _ in part.places]
    names = [name for p in points.parts for name in (*p.names, *[""] * (p.n_points - len(p.names)))]
    arrays = {
        "frequency_hz": shapes.frequency_hz,
        "damping_ratio": shapes.damping_ratio,
        "mode_numbers": np.array(shapes.numbers, int),
        "mode_names": np.array(shapes.names, np.str_),
        "nodes": axes.vectors(points.places),
        "node_bodies": np.array(bodies, np.str_),
        "node_names": np.array(names, np.str_),
        "triangles": points.triangles,
        "lines": points.lines,
        "shapes": axes.motions(points.shapes(shapes.coordinates, shapes.dofs)),
        "units": np.array(UNITS),
        "axes": np.array(axes.text),
    }
    if shapes.eigenvalue is not None and shapes.modal_a is not None:
        arrays |= {"eigenvalue": shapes.eigenvalue, "modal_a": shapes.modal_a}
    return arrays_file(arrays)


def body_file(body: FlexibleBody, axes: FileAxes) -> bytes:
    """Return an .npz file of a body, as a vehicle folder has its modes, in m and kg."""
    attachments = tuple(
        replace(a, position=axes.vectors(a.position), shapes=axes.motions(a.shapes))
        for a in body.attachments
    )
    nodes, shapes = axes.vectors(body.nodes), axes.motions(body.shapes)
    return arrays_file(body_arrays(replace(body, attachments=attachments, nodes=nodes, shapes=shapes)))
