"""How large a display mesh may be, checked before it takes memory or time."""

import os

from modeviz.errors import VehicleError

VARIABLE = "MODEVIZ_MESH_LIMIT"
"""The environment variable that allows meshes to be so many times as large."""

LARGEST_FILE = 256_000_000
"""Bytes."""

LARGEST_TEXT = 128_000_000
"""Bytes of a file whose numbers are text."""

LARGEST_DOCUMENT = 16_000_000
"""Bytes of a glTF's JSON, which takes ten times as much memory."""

MOST_POINTS = 1_000_000
"""Vertices of a file, and faces: what a page still turns."""

MOST_PARTS = 10_000
"""Parts of a file, each of which a page draws by itself."""

MOST_PIXELS = 100_000_000
"""Pixels of all textures of a file."""


def check_size(what: str, found: int, most: int) -> None:
    """Checks that there is not too much of something.

    Args:
        what: there is, in the plural.
        found: how many.
        most: how many are read, unless `VARIABLE` is set.

    Raises:
        VehicleError: there are more.
    """
    allowed = int(most * _factor())
    if found > allowed:
        raise VehicleError(
            f"found {found:,} {what}, expected at most {allowed:,}; "
            f"{VARIABLE}={-(-found // most)} in the environment would allow them"
        )


def _factor() -> float:
    text = os.environ.get(VARIABLE, "1")
    try:
        factor = float(text)
    except ValueError:
        factor = 0.0
    if not 1 <= factor <= 1000:
        raise VehicleError(f"{VARIABLE}: found {text!r}, expected a number from 1 to 1000")
    return factor
