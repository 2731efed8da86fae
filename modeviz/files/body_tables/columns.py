"""The columns of a table of rigid bodies: what headers mean, and the signs of products of inertia."""

import re
from collections.abc import Iterator, Mapping, Sequence

from modeviz.errors import VehicleError, quoted
from modeviz.files.columns import Column, Kind, bare, split_header
from modeviz.vehicle.local_axes import AXES

CENTER = ("cg_x", "cg_y", "cg_z")
POINT = ("point_x", "point_y", "point_z")
CRANK = ("crank_x", "crank_y", "crank_z")
MOMENTS = ("ixx", "iyy", "izz")
PRODUCTS = ("ixy", "ixz", "iyz")
NEGATIVE = tuple(f"-{product}" for product in PRODUCTS)
"""The elements of the matrix, which are the products with the other sign."""

KINDS: Mapping[str, Kind] = {
    **dict.fromkeys(("name", "role", "label", "mesh", "mesh_unit", "inertia_at", "note"), "text"),
    "mass": "mass",
    **dict.fromkeys((*CENTER, *POINT), "length"),
    **dict.fromkeys(CRANK, "number"),
    **dict.fromkeys((*MOMENTS, *PRODUCTS, *NEGATIVE), "inertia"),
}
"""Every column that is read, and of what its numbers are."""


def _synonyms() -> Iterator[tuple[str, str]]:
    for name in KINDS:
        yield bare(name), name
    for axis, center, point in zip(AXES, CENTER, POINT, strict=True):
        words = (
            f"{axis} {axis}cg cog{axis} {axis}cog centerofgravity{axis} centreofgravity{axis} com{axis}"
        )
        yield from ((word, center) for word in words.split())
        yield f"inertiapoint{axis}", point
        yield f"crankaxis{axis}", f"crank_{axis}"
    yield from (("body", "name"), ("m", "mass"), ("weight", "mass"), ("remark", "note"))
    yield from (("comment", "note"), ("inertiaabout", "inertia_at"), ("about", "inertia_at"))


SYNONYMS: Mapping[str, str] = dict(_synonyms())
"""Headers without spaces and marks, and the columns that they mean."""

_PRODUCT = re.compile(
    r"i(?P<axes>xy|xz|yz)(\s*[=:]?\s*(?P<sign>[-+\u2212])\s*(∫|Σ|int\w*|sum)?[\s*·⋅()xyzdm]*)?",
    re.IGNORECASE,
)
"""Such as "Ixy = +int x*y dm"."""

SIGNS = (
    "'Ixy = +int x*y dm [kg m^2]' for the product of inertia, or 'Ixy = -int x*y dm [kg m^2]' for the "
    "element of the matrix"
)


def spoken(column: str) -> str:
    """Return a column as people write it."""
    if column in NEGATIVE:
        return f"I{column[2:]} = -int"
    if column in PRODUCTS:
        return f"I{column[1:]} = +int"
    return column.capitalize() if column in MOMENTS else column


def read_headers(cells: Sequence[str]) -> tuple[dict[int, Column], list[str]]:
    """Return the columns that are read, by where they stand, and the headers of others.

    Raises:
        VehicleError: two mean the same, or a product does not say its sign.
    """
    columns: dict[int, Column] = {}
    others = []
    for place, header in enumerate(cells):
        name, unit = split_header(header, _meaning)
        if not header:
            continue
        if (meaning := _meaning(name)) is None:
            others.append(header)
            continue
        if twin := next(
            (c for c in columns.values() if c.name.lstrip("-") == meaning.lstrip("-")), None
        ):
            raise VehicleError(f"columns {quoted(twin.header)} and {quoted(header)} mean the same")
        columns[place] = Column(header, meaning, unit, KINDS[meaning])
    return columns, others


def _meaning(text: str) -> str | None:
    """The column that a header without its unit means; raises VehicleError if its sign is not said."""
    found = _PRODUCT.fullmatch(text.strip())
    if found is None:
        return SYNONYMS.get(bare(text))
    if found["sign"] is None:
        raise VehicleError(f"column {quoted(text)}: does not say its sign, expected {SIGNS}")
    return f"{'' if found['sign'] == '+' else '-'}i{found['axes'].lower()}"
