"""How people write where a component stands in the vehicle."""

import re

import numpy as np

from modeviz.errors import VehicleError, quoted
from modeviz.files.schema.axes import axes_of
from modeviz.formats.component import Component
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.pose import Pose

FORMS = (
    "where its axes point, 'x forward, y left, z up' or 'x=0,1,0 y=-1,0,0', with 'at X,Y,Z' where its "
    "origin is; or three points or more, '12=X,Y,Z; 340=X,Y,Z; X,Y,Z=X,Y,Z', each a node or a place "
    "and where it is in the vehicle; lengths in the files' units"
)

AXIS = re.compile(r"([xyz])\s*=\s*([^xyz=\s]+)")
WORTH_A_WORD = 1e-4
"""m: points of a pose that are nearer to their places are at them."""

AT = re.compile(r"(?:^|,?\s)at\s+([^=]+)$")


def parse_pose(text: str, component: Component, length: float, axes: Floats) -> Pose:
    """Return the pose that is written in one of the `FORMS`.

    Args:
        text: as it is written.
        component: whose nodes are named.
        length: m of one of its units.
        axes: (3, 3), of the vehicle's file: turns what is in them into ours, see `axes_of`.

    Raises:
        VehicleError: it is written otherwise, or is no pose.
    """
    try:
        return _pose(text.strip(), component, length, axes)
    except ValueError:
        raise VehicleError(f"found {quoted(text)}, expected {FORMS}") from None


def misfit_notes(pose: Pose) -> tuple[str, ...]:
    """Return a sentence on a pose whose points do not quite fit their places, or none."""
    if pose.misfit < WORTH_A_WORD:
        return ()
    return (f"the points of the pose are up to {1000 * pose.misfit:.2g} mm from their places",)


def _pose(text: str, component: Component, length: float, axes: Floats) -> Pose:
    """Raises ValueError if it is written otherwise."""
    if not text:
        raise ValueError
    if ";" in text:
        pairs = [part.split("=") for part in text.split(";") if part.strip()]
        points = [_point(component, point.strip()) for point, _ in pairs]
        places = [_numbers(place) for _, place in pairs]
        return Pose.from_points(length * np.array(points), length * np.array(places))
    origin = np.zeros(3)
    if found := AT.search(text):
        origin = length * _numbers(found[1])
        text = text[: found.start()].strip()
    if not text:
        return Pose(np.eye(3), origin)
    if "=" not in text:
        return Pose(axes.T @ axes_of(text), origin)
    given = {axis: _numbers(values.rstrip(",")) for axis, values in AXIS.findall(text)}
    if AXIS.sub("", text).strip(" ,") or not {"x", "y"} <= given.keys():
        raise ValueError
    return Pose.from_axes(given["x"], given["y"], given.get("z"), origin)


def _point(component: Component, text: str) -> Floats:
    """The place of a node, or a place, in the file's units."""
    if not text.isdecimal():
        return _numbers(text)
    places = component.nodes[component.node_ids == int(text)]
    if len(places) != 1 or not np.isfinite(places).all():
        raise VehicleError(f"there is no node {text} with a place")
    return places[0]


def _numbers(text: str) -> Floats:
    """Three of them; raises ValueError."""
    x, y, z = (float(part) for part in text.split(","))
    numbers = np.array([x, y, z])
    if not np.isfinite(numbers).all():
        raise ValueError
    return numbers
