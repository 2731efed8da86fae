"""A COLLADA file as it stands: its elements, and what their references name.

COLLADA 1.4.1 specification (Khronos Group, 2008). The XML is read by expat without document types: so
there are no entities, which could grow without end or bring in other files.

pycollada, through trimesh, was weighed: it reads the same elements, but hands documents with entities
to ElementTree, takes dateutil along, and leaves units and axes to the caller.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

from modeviz.errors import VehicleError, quoted
from modeviz.files.mesh_formats.limits import LARGEST_TEXT, check_size
from modeviz.files.mesh_formats.parts import numbers
from modeviz.vehicle.arrays import Floats

MOST_ELEMENTS = 300_000
"""Of the XML: each takes some hundred bytes."""


@dataclass(frozen=True, eq=False)
class Dae:
    """A file that is being read."""

    root: Element
    """Names of its elements are without their namespace."""
    by_id: dict[str, Element]

    def named(self, element: Element, key: str) -> Element:
        """The element that an attribute refers to.

        Raises:
            VehicleError: there is none, or it is in another file.
        """
        reference = element.get(key, "")
        where = f"<{element.tag}>: {key}"
        if not reference.startswith("#"):
            raise VehicleError(
                f"{where}: found {quoted(reference)}, expected something in the file, such as '#body'"
            )
        if reference[1:] not in self.by_id:
            raise VehicleError(f"{where}: {quoted(reference)} is named and not there")
        return self.by_id[reference[1:]]


def read_document(content: bytes) -> Dae:
    """The elements of a file.

    Raises:
        VehicleError: it is no COLLADA file, damaged, too large, or has a document type.
    """
    check_size("bytes of text", len(content), LARGEST_TEXT)
    builder, n_elements = TreeBuilder(), 0

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal n_elements
        n_elements += 1
        if n_elements % 1000 == 0:
            check_size("elements", n_elements, MOST_ELEMENTS)
        builder.start(_local(tag), attributes)

    def refuse(*_: object) -> None:
        raise VehicleError("found a document type or entities, expected a COLLADA file, which has none")

    parser = expat.ParserCreate(namespace_separator="}")
    parser.buffer_text = True
    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: builder.end(_local(tag))
    parser.CharacterDataHandler = builder.data
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(content, True)
        root = builder.close()
    except (expat.ExpatError, LookupError, ValueError) as error:
        raise VehicleError(f"is not whole XML ({error})") from None
    if root.tag != "COLLADA":
        raise VehicleError(f"found the element <{root.tag[:80]}>, expected <COLLADA>")
    return Dae(root, {id_: element for element in root.iter() if (id_ := element.get("id"))})


def values(element: Element, n: int | None = None) -> Floats:
    """The numbers in an element.

    Args:
        element: of the file.
        n: how many there have to be.

    Raises:
        VehicleError: there are others, or something else.
    """
    try:
        found = numbers((element.text or "").encode())
    except VehicleError as error:
        raise VehicleError(f"<{element.tag}>: {error}") from None
    if n is not None and len(found) != n:
        raise VehicleError(f"<{element.tag}>: found {len(found)} numbers, expected {n}")
    return found


def children(element: Element, *tags: str) -> Iterator[Element]:
    """The elements of these names right within one."""
    return (child for child in element if child.tag in tags)


def child(element: Element, tag: str) -> Element:
    """The first element of a name right within one.

    Raises:
        VehicleError: there is none.
    """
    found = element.find(tag)
    if found is None:
        raise VehicleError(f"<{element.tag}> has no <{tag}>")
    return found


def _local(tag: str) -> str:
    """A name without its namespace."""
    return tag.rpartition("}")[2]
