"""Signs of the way round that a vehicle stands: x rearward, y to the right, z up.

Nothing in a file proves it, but names, tyres and the origin tell: "front left" is before "rear left", a
wheel's centre is above the ground, and what has an axle at the origin has its front axle there.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.vehicle import Vehicle

_WORDS = {
    "front": "front fore fl fr lf rf vorn vorne vl vr",
    "rear": "rear back aft rl rr lr hinten hl hr",
    "left": "left lh fl rl lf lr links vl hl",
    "right": "right rh fr rr rf rechts vr hr",
}
_BEFORE = ((0, "front", "rear"), (1, "left", "right"))
"""Along which axis what is called the one comes before what is called the other."""

_SIDES = (("behind", "before"), ("to the right of", "to the left of"))
"""Words for where the first is, by axis, not as it ought to be and as it ought to be."""

_Things = Sequence[tuple[str, Floats]]

_AT_ORIGIN, _BEFORE_ORIGIN = 0.1, 0.5
"""Parts of the wheelbase: an axle nearer than the first is at the origin."""


@dataclass(frozen=True)
class Sign:
    """Something that tells along which way one of the axes is."""

    axis: int
    is_right: bool
    words: str
    """What it is."""


def signs(vehicle: Vehicle) -> Iterator[Sign]:
    """The signs that tell which way round a vehicle stands."""
    for axis, first, second in _BEFORE:
        for things in (_tyres(vehicle), [*_tyres(vehicle), *_placed(vehicle)]):
            before, after = (_named(things, word) for word in (first, second))
            if before and after:
                a, b = (median(place[axis] for _, place in found) for found in (before, after))
                is_right = bool(a <= b)
                yield Sign(axis, is_right, _pair(before, after, axis, is_right))
                break
    yield from _signs_of_tyres(vehicle)


def _pair(before: _Things, after: _Things, axis: int, is_right: bool) -> str:
    """Words for the first two things that stand to each other as most do."""
    pairs = ((one, two) for one in before for two in after)
    one, two = next((a, b) for a, b in pairs if bool(a[1][axis] <= b[1][axis]) is is_right)
    return f"{one[0]!r} is {_SIDES[axis][is_right]} {two[0]!r}"


def _signs_of_tyres(vehicle: Vehicle) -> Iterator[Sign]:
    if not vehicle.tyres:
        return
    x = [tyre.wheel_center[0] for tyre in vehicle.tyres]
    wheelbase = max(x) - min(x)
    if abs(max(x)) < _AT_ORIGIN * wheelbase and min(x) < -_BEFORE_ORIGIN * wheelbase:
        yield Sign(0, False, "the axle at the origin is the last")
    elif abs(min(x)) < _AT_ORIGIN * wheelbase and max(x) > _BEFORE_ORIGIN * wheelbase:
        yield Sign(0, True, "the axle at the origin is the first")
    heights = [tyre.wheel_center[2] - tyre.points[1, 2] for tyre in vehicle.tyres]
    if any(heights):
        low = vehicle.tyres[int(np.argmin(heights))].name
        where = "above" if min(heights) >= 0 else "below"
        yield Sign(2, min(heights) >= 0, f"the centre of the wheel on {low!r} is {where} the ground")


def orientation_doubts(vehicle: Vehicle, axes: Floats) -> tuple[str, ...]:
    """Sentences on a vehicle that seems to stand the wrong way round; none if it does not.

    Args:
        vehicle: as it was read.
        axes: (3, 3), what turned its file's axes into the vehicle's.
    """
    found = list(signs(vehicle))
    wrong = {sign.axis: sign.words for sign in reversed(found) if not sign.is_right}
    if not wrong:
        return ()
    right = {sign.axis for sign in found} - set(wrong)
    better = _axes_text(axes, _reversed(set(wrong), right))
    advice = f'; say axes = "{better}" if that is how the file has them' if better else ""
    return (
        f"{' and '.join(wrong[axis] for axis in sorted(wrong))}, with axes taken as "
        f'"{_axes_text(axes, set())}"{advice}',
    )


def _reversed(wrong: set[int], right: set[int]) -> set[int] | None:
    """The axes to reverse so that a right-handed frame is right; None where that cannot be."""
    if len(wrong) % 2 == 0:
        return wrong
    unknown = [axis for axis in (1, 0, 2) if axis not in wrong | right]
    return {*wrong, unknown[0]} if unknown else None


def _axes_text(axes: Floats, reverse: set[int] | None) -> str:
    """The axes of a file in words, those of the vehicle in `reverse` the other way."""
    if reverse is None:
        return ""
    ways = (("rearward", "forward"), ("right", "left"), ("up", "down"))
    words = []
    for name, column in zip("xyz", axes.T, strict=True):
        line = int(np.abs(column).argmax())
        words.append(f"{name} {ways[line][bool(column[line] < 0) != (line in reverse)]}")
    return ", ".join(words)


def _tyres(vehicle: Vehicle) -> list[tuple[str, Floats]]:
    return [(tyre.name, tyre.points[1]) for tyre in vehicle.tyres]


def _placed(vehicle: Vehicle) -> Iterable[tuple[str, Floats]]:
    """Everything else that has a name and a place."""
    yield from ((c.name, c.points[0]) for c in vehicle.all_connections)
    yield from ((point.name, point.position) for point in vehicle.response_points)
    for body in vehicle.bodies:
        if isinstance(body, FlexibleBody):
            yield from ((a.name, a.position) for a in body.attachments)
        else:
            yield body.name, body.center_of_gravity


def _named(things: Iterable[tuple[str, Floats]], word: str) -> list[tuple[str, Floats]]:
    words = set(_WORDS[word].split())
    return [(name, at) for name, at in things if words & set(re.findall(r"[a-z]+", name.lower()))]
