"""The columns of a mount table: what their headers mean, and the units that these say."""

import re
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches

from modeviz.errors import VehicleError, listed, quoted
from modeviz.files.columns import Column, Kind, bare, split_header
from modeviz.files.mount_tables.limits import RATIOS, STATIC_RATIO, TRAVEL
from modeviz.vehicle.local_axes import AXES

NAMED = ("vertical", "lateral", "fore_aft")
"""Directions that are called so in all axes."""

TEXTS = (
    "name",
    "group",
    "body_1",
    "body_2",
    "attachment_1",
    "attachment_2",
    "property",
    "units",
    "angle_order",
)

ROLL_PITCH_YAW = {"roll": "angle_x", "pitch": "angle_y", "yaw": "angle_z"}
"""Headers of angles whose order is known: about the fixed x, then y, then z."""

REMARKS = {"note", "notes", "remark", "remarks", "comment", "comments"}
"""Headers of columns for people, which say nothing here."""


EXACT = (STATIC_RATIO, *RATIOS)
"""Headers that nothing else is a misspelling of, such as a static rate."""


def _kinds() -> Iterator[tuple[str, Kind]]:
    for name in TEXTS:
        yield name, "text"
    for axis in AXES:
        yield axis, "length"
        yield f"{axis}_2", "length"
        yield f"k_r{axis}", "rotational_stiffness"
        yield f"c_{axis}", "damping"
        yield f"c_r{axis}", "rotational_damping"
        for component in AXES:
            yield f"{axis}_axis_{component}", "number"
    for direction in (*AXES, *NAMED):
        for what in ("k", "softest", "stiffest"):
            yield f"{what}_{direction}", "stiffness"
        for what in TRAVEL:
            yield f"{what}_{direction}", "length"
    for axis in AXES:
        yield f"angle_{axis}", "angle"
        for what in ("softest", "stiffest"):
            yield f"{what}_r{axis}", "rotational_stiffness"
            yield f"{what}_c_{axis}", "damping"
    yield "loss_factor", "ratio"
    for name in ("elastic_center", *EXACT):
        yield name, "number"


KINDS: Mapping[str, Kind] = dict(_kinds())
"""Every column that is read, and of what its numbers are."""

BOUNDS = {
    **dict.fromkeys(("min", "minimum", "lower", "softest"), "softest"),
    **dict.fromkeys(("max", "maximum", "upper", "stiffest"), "stiffest"),
}
"""Words in a header that make it that of a bound."""


def _synonyms() -> Iterator[tuple[str, str]]:
    """Headers without spaces and marks, and the columns that they mean."""
    for name in KINDS:
        yield name.replace("_", ""), name
    words = {
        "name": "mount mountname connection bushing isolator id designation element spring label",
        "group": "mountgroup partnumber partno",
        "property": "propertyfile file busfile",
        "units": "unit",
        "loss_factor": "eta η tandelta tanδ tand lossangletan ge structuraldamping",
        "elastic_center": "elasticcentre s",
    }
    for side, letter, order, marker in (("1", "a", "first", "i"), ("2", "b", "second", "j")):
        words[f"body_{side}"] = (
            f"body{letter} {order}body part{side} component{side} component{letter} bodyname{side} "
            f"body{marker} {marker}body"
        )
        words[f"attachment_{side}"] = (
            f"attachment{letter} node{side} node{letter} node{marker} grid{side} grid{letter} "
            f"g{letter} g{side} point{side} hardpoint{side} nodeid{side} {order}node"
        )
    words["body_1"] += " body from frombody ibody"
    words["body_2"] += " to tobody"
    words["attachment_1"] += " attachment node grid nodeid"
    for number, axis in enumerate(AXES, 1):
        words[axis] = (
            f"{axis}1 pos{axis} {axis}pos position{axis} {axis}position coord{axis} {axis}coord "
            f"{axis}coordinate location{axis} {axis}a"
        )
        words[f"{axis}_2"] = f"{axis}b pos{axis}2 position{axis}2 second{axis}"
        words[f"k_{axis}"] = (
            f"k{number} stiffness{axis} {axis}stiffness rate{axis} {axis}rate {axis}k springrate{axis}"
        )
        words[f"k_r{axis}"] = (
            f"k{number + 3} kt{axis} krot{axis} kr{number} rotationalstiffness{axis} "
            f"torsionalstiffness{axis} rotationalrate{axis} stiffnessr{axis} ktheta{axis}"
        )
        words[f"c_{axis}"] = f"c{number} b{number} damping{axis} {axis}damping b{axis} {axis}c"
        words[f"c_r{axis}"] = (
            f"c{number + 3} b{number + 3} ct{axis} crot{axis} rotationaldamping{axis} dampingr{axis} "
            f"br{axis}"
        )
    for header, name in ROLL_PITCH_YAW.items():
        words[name] = header
    words["angle_order"] = "order orderofangles rotationorder"
    for direction in (*AXES, *NAMED):
        plain = direction.replace("_", "")
        for name, bound in zip(TRAVEL, ("min", "max"), strict=True):
            words[f"{name}_{direction}"] = (
                f"travel{plain}{bound} travel{bound}{plain} {bound}travel{plain} {plain}travel{bound}"
            )
    for direction in NAMED:
        plain = direction.replace("_", "")
        words[f"k_{direction}"] = f"{plain} {plain}rate {plain}stiffness k{plain}"
    words["k_fore_aft"] += " longitudinal longitudinalrate longitudinalstiffness klongitudinal"
    yield from ((word, name) for name, several in words.items() for word in several.split())


SYNONYMS: Mapping[str, str] = dict(_synonyms())


MISSPELT = [word for word, name in SYNONYMS.items() if name not in EXACT]
"""What headers may be meant for that mean nothing."""


WEAK = {"id", "label", "designation", "element", "partnumber", "partno", "nodeid", "unit", "file", "s"}
"""Synonyms that mean something else where another column means the same."""


def read_headers(cells: Sequence[str]) -> tuple[dict[int, Column], list[str]]:
    """Return the columns that are read, by where they stand, and the headers of others.

    Raises:
        VehicleError: two mean the same, or one is likely a misspelt one.
    """
    columns: dict[int, Column] = {}
    others = []
    for place, header in enumerate(cells):
        if not header:
            continue
        column = _column(header)
        if column is None:
            others.append(header)
            continue
        twin = next((at for at, c in columns.items() if c.name == column.name), None)
        if twin is None:
            columns[place] = column
        elif _is_weak(header):
            others.append(header)
        elif _is_weak(columns[twin].header):
            others.append(columns.pop(twin).header)
            columns[place] = column
        else:
            raise VehicleError(
                f"columns {quoted(columns[twin].header)} and {quoted(header)} both mean {column.name}"
            )
    return columns, others


def _is_weak(header: str) -> bool:
    return bare(header) in WEAK


def _column(header: str) -> Column | None:
    """What a header means; None if nothing that is read."""
    name, unit = split_header(header, _meaning)
    if meaning := _meaning(name):
        return Column(header, meaning, unit, KINDS[meaning])
    close = get_close_matches(bare(name), MISSPELT, n=1, cutoff=0.85)
    if close:
        raise VehicleError(
            f"unknown column {quoted(header)}: did you mean {SYNONYMS[close[0]]}? There are "
            f"{listed(KINDS)}"
        )
    return None


def _meaning(text: str) -> str | None:
    """The column that a header without its unit means."""
    if plain := SYNONYMS.get(bare(text)):
        return plain
    words = re.findall(r"[^\W\d_]+|\d+", text.lower())
    for place, word in enumerate(words):
        if bound := BOUNDS.get(word):
            rate = SYNONYMS.get("".join([*words[:place], *words[place + 1 :]]), "")
            rate = rate or (words[1 - place] if len(words) == 2 else "")
            meant = f"{bound}_{rate.removeprefix('k_')}"
            return meant if meant in KINDS else None
    return None


def has_known_order(column: Column) -> bool:
    """Return whether a column is one of roll, pitch and yaw, angles in an order of their own."""
    return bare(split_header(column.header, _meaning)[0]) in ROLL_PITCH_YAW
