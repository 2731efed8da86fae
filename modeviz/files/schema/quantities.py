"""Quantities of the numbers of a field: each field of a record that holds any has one of these.

A number of which nothing is said would pass for one without a unit, whatever its file says of units;
so a record with such a field cannot be made.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from inspect import get_annotations
from typing import Annotated, Any, get_args, get_origin

from modeviz.files.schema.axes import Turns
from modeviz.files.schema.hints import annotations_of
from modeviz.units import QuantityName

Vector = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Quantity:
    """The annotation of numbers in the unit that the file says for a quantity.

    That of a text means the numbers of the file that it names.
    """

    name: QuantityName | None = None
    """None, if it depends on what the table has as its `kind`."""
    by_kind: Mapping[str, QuantityName] = field(default_factory=dict)

    @property
    def names(self) -> tuple[QuantityName, ...]:
        """All that it can be."""
        return (self.name,) if self.name else tuple(self.by_kind.values())

    def named(self, table: Mapping[str, Any]) -> QuantityName:
        """The name of the quantity in a table."""
        return self.name or self.by_kind[table["kind"]]


@dataclass(frozen=True, eq=False)
class FixedUnit:
    """The annotation of numbers that have the same unit, or none, whatever a file says of its units."""

    name: str
    """Empty for none."""


UNITLESS = FixedUnit("")


def quantity_of(record: type, key: str) -> QuantityName | None:
    """The quantity of a record's key, or of the file that it names; None if that is fixed."""
    found = annotations_of(record, Quantity)[key]
    return found and found.name


def check_annotations(record: type) -> None:
    """Checks that a record says of its own numbers what they are, and of its vectors how they turn.

    Raises:
        TypeError: of a field nothing is said.
    """
    for key, hint in get_annotations(record, eval_str=True).items():
        if _is_bare(hint, (int, float), (Quantity, FixedUnit)):
            raise TypeError(f"{record.__name__}.{key}: numbers without a Quantity or a FixedUnit")
        if _is_bare(hint, (Vector,), (Turns,)):
            raise TypeError(f"{record.__name__}.{key}: vectors that do not say how they turn")


def _is_bare(hint: Any, kinds: tuple[Any, ...], annotations: tuple[type, ...]) -> bool:
    """Whether a hint has one of these kinds in it without one of these annotations."""
    inner = get_args(hint)
    if get_origin(hint) is Annotated:
        said = any(isinstance(note, annotations) for note in inner[1:])
        return not said and _is_bare(inner[0], kinds, annotations)
    return hint in kinds or any(_is_bare(kind, kinds, annotations) for kind in inner)
