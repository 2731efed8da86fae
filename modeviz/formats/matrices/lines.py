"""Files of text that may be long, line by line."""

from collections.abc import Iterator
from typing import BinaryIO

from modeviz.errors import VehicleError, quoted

LONGEST_LINE = 10_000
"""Letters: of files with matrices none has nearly as many."""


def lines_of(file: BinaryIO) -> Iterator[str]:
    """Yield the lines of a file, with their ends.

    Raises:
        VehicleError: one is longer than any with numbers, as in a file that is no text.
    """
    while content := file.readline(LONGEST_LINE + 1):
        line = content.decode("latin-1")
        if len(line) > LONGEST_LINE:
            raise VehicleError(
                f"found a line of more than {LONGEST_LINE:,} letters, {quoted(line)}, expected numbers"
            )
        yield line
