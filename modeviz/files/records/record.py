"""The base of all records of `vehicle.toml`."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeVar

import msgspec
import numpy as np

from modeviz.errors import ModevizError, VehicleError
from modeviz.files.schema.quantities import check_annotations

R = TypeVar("R")
P = TypeVar("P")


MOST_ERRORS = 5
"""Of what is wrong in one place with many records, so much is said at once."""


class Record(msgspec.Struct, forbid_unknown_fields=True, omit_defaults=True):
    """A table of a file, whose numbers have their quantities at its fields."""

    def __init_subclass__(cls, **options: Any) -> None:
        """Raises TypeError for a field of which nothing is said, see `check_annotations`."""
        super().__init_subclass__(**options)
        check_annotations(cls)


class FileRecord(Record, kw_only=True):
    """A whole file."""

    units: dict[str, str] = msgspec.field(default_factory=dict)
    """Of its numbers, quantity to unit."""


class RecordError(VehicleError):
    """A record that cannot be built, with its key path: "problem[0].group[1]"."""

    def __init__(self, path: str, words: str) -> None:
        super().__init__(f"{path}: {words}")
        self.path: str = path
        self.words: str = words


def built(records: Iterable[R], key: str, build: Callable[[R], P]) -> tuple[P, ...]:
    """The values that records build; an error names every record that builds none, and its table."""
    parts: list[P] = []
    errors: list[RecordError] = []
    for index, record in enumerate(records):
        path = f"{key}[{index}]"
        try:
            parts.append(build(record))
        except RecordError as error:
            errors.append(RecordError(f"{path}.{error.path}", error.words))
        except ModevizError as error:
            errors.append(RecordError(path, str(error)))
    if errors:
        raise _together(errors) from None
    return tuple(parts)


def _together(errors: Sequence[RecordError]) -> RecordError:
    """One error that says what several say, the first `MOST_ERRORS` of very many."""
    first, *others = errors
    said = [first.words, *map(str, others[: MOST_ERRORS - 1])]
    n_more = len(errors) - len(said)
    return RecordError(first.path, "; ".join([*said, *([f"{n_more} more"] if n_more else [])]))


def said(kind: type[Record], fields: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a record that differ from its defaults."""
    default = {field.name: field.default for field in msgspec.structs.fields(kind)}
    return {key: value for key, value in fields.items() if value != default[key]}


def tuples(value: Any) -> Any:
    """An array as tuples, whatever else as it is."""
    if isinstance(value, np.ndarray):
        return tuple(map(tuples, value)) if value.ndim else float(value)
    return float(value) if isinstance(value, np.floating) else value
