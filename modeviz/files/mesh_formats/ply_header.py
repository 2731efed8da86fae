"""The header of a PLY file: its elements and their properties."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeviz.errors import VehicleError, check_unique, listed, quoted

LONGEST_HEADER = 100_000
"""Bytes."""

TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "float": "f4",
    "double": "f8",
    "int8": "i1",
    "uint8": "u1",
    "int16": "i2",
    "uint16": "u2",
    "int32": "i4",
    "uint32": "u4",
    "float32": "f4",
    "float64": "f8",
}
ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">", "ascii": ""}


@dataclass(frozen=True)
class Property:
    """A property of every item of an element: a number, or a list of them with its length before."""

    name: str
    kind: np.dtype
    length: np.dtype | None = None
    """Of a list, the type of its length."""


@dataclass(frozen=True)
class Element:
    """The vertices, the faces, or something else."""

    name: str
    count: int
    properties: tuple[Property, ...]


def read_header(content: bytes) -> tuple[str, Sequence[Element], bytes]:
    """The byte order, "" of a text; the elements; and what comes after the header.

    Raises:
        VehicleError: there is no such header.
    """
    head, end, _ = content[:LONGEST_HEADER].partition(b"end_header")
    lines = head.decode("latin-1").split("\n")
    if lines[0].strip() != "ply" or not end:
        raise VehicleError("found no header of a PLY from 'ply' to 'end_header'")
    words = [line.split() for line in lines[1:] if line.split()]
    formats = [line[1] for line in words if line[0] == "format" and len(line) > 1]
    if len(formats) != 1 or formats[0] not in ORDERS:
        raise VehicleError(
            f"found the format {listed(map(quoted, formats))}, expected one of {', '.join(ORDERS)}"
        )
    order = ORDERS[formats[0]]
    line_end = content.find(b"\n", len(head))
    start = line_end + 1 if line_end >= 0 else len(content)
    return order, _elements(words, order), content[start:]


def _elements(lines: Sequence[Sequence[str]], order: str) -> list[Element]:
    elements: list[Element] = []
    for line in lines:
        try:
            match line:
                case ["element", name, count]:
                    elements.append(Element(name, _count(count), ()))
                case ["property", *rest]:
                    last = elements.pop()
                    new = (*last.properties, _property(rest, order))
                    elements.append(replace(last, properties=new))
        except (ValueError, KeyError, IndexError):
            raise VehicleError(f"found the header line {' '.join(line)[:80]!r}") from None
    for element in elements:
        check_unique(f"element {element.name}: property", (p.name for p in element.properties))
    return elements


def _count(text: str) -> int:
    count = int(text)
    if count < 0:
        raise ValueError
    return count


def _property(words: Sequence[str], order: str) -> Property:
    """A property's line; all numbers of a text are of eight bytes."""
    types = [TYPES[word] for word in words[:-1] if word != "list"]
    kinds = [np.dtype(order + kind if order else "f8") for kind in types]
    if words[0] == "list":
        length, kind = kinds
        return Property(words[-1], kind, length)
    (kind,) = kinds
    return Property(words[-1], kind)
