"""Named groups of nodes of a universal file: data sets 2467 and 2477."""

from collections.abc import Iterator

from modeviz.errors import VehicleError
from modeviz.formats.node_sets import NodeSet
from modeviz.formats.universal.blocks import Block, whole_numbers

NODE = 7
"""The kind of an entity that is a node."""

WIDTH = 4
"""Numbers of an entity: its kind, its label and two more."""


def read_groups(block: Block) -> dict[str, NodeSet]:
    """Return the groups that have nodes, by name: "GROUP:left mount".

    Raises:
        VehicleError: there are other things than groups, or fewer entities than they say.
    """
    return {
        f"GROUP:{name}": NodeSet("mean", tuple(dict.fromkeys(nodes)))
        for name, nodes in _groups(block)
        if nodes
    }


def _groups(block: Block) -> Iterator[tuple[str, list[int]]]:
    """The name of each group and its nodes."""
    while block.content.strip():
        (first, name), rest = block.split(2)
        n_entities = whole_numbers(first, 8)[7]
        if n_entities < 0:
            raise VehicleError(f"found a group of {n_entities} entities")
        n_lines = -(-n_entities // 2)
        block = Block(block.kind, block.line + 2, rest)
        lines, rest = block.split(n_lines)
        block = Block(block.kind, block.line + n_lines, rest)
        entities = [number for line in lines for number in whole_numbers(line, WIDTH)]
        kinds, labels = entities[::WIDTH], entities[1::WIDTH]
        yield (
            name.strip(),
            [i for kind, i in zip(kinds, labels, strict=False) if kind == NODE and i > 0],
        )
