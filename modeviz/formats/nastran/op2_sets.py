"""Sets of grids of an OP2 file: its rigid and averaging elements.

After MSC Nastran's DMAP Programmer's Guide, "GEOM4": records RBE2 and RBE3. After each element newer
versions have a coefficient of expansion, and then a temperature too.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from modeviz.errors import VehicleError
from modeviz.formats.nastran.bulk import Card
from modeviz.formats.nastran.op2_records import Table
from modeviz.formats.nastran.rigid_elements import node_set
from modeviz.formats.node_sets import NodeSet
from modeviz.vehicle.arrays import Array, Floats

TABLES = ("GEOM4", "GEOM4S")
RBE2, RBE3 = (6901, 69), (7101, 71)

MOST_WORDS_AFTER = 2
"""Of an element, which say nothing of its grids."""

LIST_END, OTHERS, ELEMENT_END = -1, -2, -3
"""What ends a list of grids; what is between the last two of an RBE3 is not asked for."""


def read_sets(tables: Sequence[Table]) -> dict[str, NodeSet]:
    """Return the sets of a file by name, as `node_set` has those of cards.

    Records that are written otherwise, or damaged, have none: nothing else depends on them.
    """
    sets: dict[str, NodeSet] = {}
    for table in tables:
        for number in range(1, len(table.records)) if table.name in TABLES else ():
            whole, real = table.whole(number), table.real(number)
            if tuple(whole[:2].tolist()) in (RBE2, RBE3):
                try:
                    sets.update(filter(None, map(node_set, _cards(whole, real))))
                except VehicleError:
                    continue
    return sets


def _cards(whole: Array, real: Floats) -> list[Card]:
    """The elements of a record as cards, by as many words after each as make sense of all."""
    kind = "RBE2" if int(whole[1]) == RBE2[1] else "RBE3"
    for n_after in range(MOST_WORDS_AFTER + 1):
        elements = list(_elements(whole[3:], LIST_END if kind == "RBE2" else ELEMENT_END, n_after))
        if elements and all(_makes_sense(whole[3:][part], kind) for part in elements):
            fields = _rigid if kind == "RBE2" else _averaging
            return [Card(kind, fields(whole[3:][part], real[3:][part])) for part in elements]
    return []


def _elements(words: Array, end: int, n_after: int) -> Iterator[slice]:
    """The words of each element without its end; nothing of a last one that does not end."""
    ends = np.flatnonzero(words == end)
    first = 0
    while first < len(words):
        later = ends[ends > first]
        if not len(later):
            return
        yield slice(first, int(later[0]))
        first = int(later[0]) + 1 + n_after


def _makes_sense(words: Array, kind: str) -> bool:
    """Whether an element begins with its number, a grid and directions."""
    directions = words[2:3].tolist() if kind == "RBE2" else words[2:3].tolist() + words[4:5].tolist()
    known = all(set(str(each)) <= set("123456") for each in directions)
    return len(words) > 3 and bool((words[:2] > 0).all()) and known


def _rigid(words: Array, real: Floats) -> list[str]:
    return [str(word) for word in words.tolist()]


def _averaging(words: Array, real: Floats) -> list[str]:
    """The fields of an RBE3 card: a weight, directions and grids, several times."""
    others = np.flatnonzero(words == OTHERS)
    last = int(others[0]) if len(others) else len(words)
    fields = [str(words[0]), "", str(words[1]), str(words[2])]
    is_weight = True
    for word, number in zip(words[3:last].tolist(), real[3:last].tolist(), strict=True):
        if word == LIST_END:
            is_weight = True
            continue
        fields.append(repr(float(number)) if is_weight else str(word))
        is_weight = False
    return fields
