"""MTL: the materials that OBJ files name, a colour each (Wavefront, 1995)."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from modeviz.errors import VehicleError, located, quoted
from modeviz.files.mesh_formats.limits import MOST_PARTS, check_size
from modeviz.vehicle.bodies import Material

LONGEST_LINE = 10_000
"""Letters; what is beyond them is cut off."""


def read_mtl(content: bytes, plain: Material) -> dict[str, Material]:
    """The materials of a file by their names.

    Colours count as they are shown; textures are in other files, which are not opened.

    Args:
        content: of the file.
        plain: what a material is where it says nothing.

    Raises:
        VehicleError: a value is no number, or there are too many materials.
    """
    found: dict[str, Material] = {}
    name = ""
    for number, key, text in _lines(content):
        if key == "newmtl":
            name = text
            found[name] = plain
            check_size("materials", len(found), MOST_PARTS)
        elif name:
            with located(f"line {number}: {key}"):
                found[name] = _with(found[name], key, text)
    return found


def _lines(content: bytes) -> Iterator[tuple[int, str, str]]:
    """The number, the first word and the rest of each line."""
    for number, line in enumerate(content.splitlines(), 1):
        key, _, rest = line[:LONGEST_LINE].decode("utf-8", "replace").strip().partition(" ")
        yield number, key, rest.strip()


def _with(material: Material, key: str, text: str) -> Material:
    """A material with what a line says of it."""
    match key:
        case "Kd" if not text.startswith(("spectral", "xyz")):
            red, green, blue = (
                np.rint(255 * np.array(_numbers(text, 1, 3) * 3)[:3]).astype(int).tolist()
            )
            return replace(material, color=(red, green, blue))
        case "d":
            return replace(material, opacity=_numbers(text.removeprefix("-halo"), 1)[0])
        case "Tr":
            return replace(material, opacity=1 - _numbers(text, 1)[0])
        case "Pr":
            return replace(material, roughness=_numbers(text, 1)[0])
        case "Pm":
            return replace(material, metallic=_numbers(text, 1)[0])
    return material


def _numbers(text: str, *counts: int) -> list[float]:
    """Numbers from 0 to 1, larger ones cut; one colour may be grey, of a single number."""
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError:
        numbers = []
    if len(numbers) not in counts or not np.isfinite(numbers).all():
        wanted = " or ".join(map(str, counts))
        raise VehicleError(f"found {quoted(text)}, expected numbers from 0 to 1, {wanted} of them")
    return np.clip(numbers, 0, 1).tolist()
