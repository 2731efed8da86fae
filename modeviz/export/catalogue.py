"""What can be written, by the name of the file: "rates.bdf", "optimised-modes.unv", "cab.glb"."""

import re
from collections.abc import Mapping
from itertools import chain, count
from pathlib import Path

from modeviz.errors import ModevizError, listed, quoted
from modeviz.export.writers import WHOLE, Writer, of_body
from modeviz.vehicle.vehicle import Vehicle

ENDINGS = frozenset(ending for formats in WHOLE.values() for ending in formats)
"""Of all files that can be written."""


def writer(path: Path, vehicle: Vehicle) -> Writer:
    """Return what makes the content of a file: its name ends in what it has, and says the format.

    Args:
        path: such as "modes.unv" or "optimised rates.csv".
        vehicle: whose it is.

    Raises:
        ModevizError: its name says nothing that there is, or not in that format.
    """
    words = contents(vehicle)
    stem, suffix = _slug(path.stem), path.suffix.lower()
    word = max((w for w in words if f"-{stem}".endswith(f"-{w}")), key=len, default=None)
    if word is None:
        raise ModevizError(
            f"found {quoted(path.name)}, expected a name that ends in what the file is to have: "
            f"{listed(words)}; such as rates.bdf or optimised-modes.unv"
        )
    if suffix not in words[word]:
        raise ModevizError(
            f"found {quoted(path.name)}, expected {word} as one of {', '.join(words[word])}"
        )
    return words[word][suffix]


def contents(vehicle: Vehicle) -> dict[str, Mapping[str, Writer]]:
    """Return what can be written of a vehicle, and for each the writers by the ending of the file."""
    words = body_words(vehicle)
    return {**{words[body.name]: of_body(body) for body in vehicle.bodies}, **WHOLE}


def body_words(vehicle: Vehicle) -> dict[str, str]:
    """Return what file names call each body: its name in small letters, with "-" between words."""
    words: dict[str, str] = {}
    for body in vehicle.bodies:
        slug = _slug(body.name) or "body"
        numbered = (f"{slug}-{number}" for number in count(2))
        taken = {*words.values(), *WHOLE}
        words[body.name] = next(word for word in chain([slug], numbered) if word not in taken)
    return words


def _slug(name: str) -> str:
    """A name in small letters and digits, with "-" for all between."""
    return re.sub(r"[\W_]+", "-", name.lower()).strip("-")
