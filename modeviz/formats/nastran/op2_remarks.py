"""What there is to know of an OP2 file beside its tables of shapes and geometry."""

import re
from collections.abc import Iterator, Sequence

import numpy as np

from modeviz.formats.nastran.model import weights_note
from modeviz.formats.nastran.op2_records import Table

KNOWN = re.compile(r"XXXXXXXX|20\d{4}|V\d.*|NX[\d.]+|OS[\d.]+|")
"""Labels of files of MSC Nastran, NX Nastran and OptiStruct, and of those that have none."""

WTMASS = "WTMASS"

SINGLE = 2
"""The kind of a parameter that is one real number; others have two words."""


def remarks(tables: Sequence[Table]) -> Iterator[str]:
    """Yield sentences on who wrote a file, if that is nobody known, and on how masses are given."""
    label = tables[0].words.label if tables else ""
    if not KNOWN.fullmatch(label):
        yield (
            f"the OP2 file is labelled {label!r}, as by no version known here; it is read as MSC "
            "Nastran's, so compare its frequencies with those printed"
        )
    for table in tables:
        if table.name in ("PVT", "PVT0") and len(table.records) > 1:
            value = _weight_factor(table)
            if value not in (None, 1.0):
                yield weights_note(f"{value:.6g}")


def _weight_factor(table: Table) -> float | None:
    """PARAM,WTMASS of a table of parameters: names in two words, then their kind and value."""
    whole, real = table.whole(1), table.real(1)
    name = table.words.letters(WTMASS.ljust(8))
    for at in range(len(whole) - 3):
        if whole[at : at + 2].tobytes() == name:
            value = real[at + 3]
            if whole[at + 2] != SINGLE and whole.itemsize == 4 and at + 5 <= len(whole):
                value = real[at + 3 : at + 5].copy().view(real.dtype.str.replace("4", "8"))[0]
            return float(value) if np.isfinite(value) else None
    return None
