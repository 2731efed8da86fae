"""Meshes sheet metal on a lattice of blocks."""

from itertools import pairwise

import numpy as np

from modeviz.fem.mesh import BeamSection, ShellSection
from modeviz.vehicle.arrays import Floats
from pickup.half_mesh import HalfMesh
from pickup.sides import Place

Corner = tuple[int, int, int]
Span = int | tuple[int, int]
"""One plane of corners, or all between two."""


class Lattice(HalfMesh):
    """A half mesh whose nodes interpolate the corners of blocks; panels and members follow them."""

    def __init__(self, corners: Floats, divisions: tuple[list[int], list[int], list[int]]) -> None:
        """Makes an empty lattice.

        Args:
            corners: (n_i, n_j, n_k, 3), the blocks' corners, m.
            divisions: along i, j and k, into how many elements each block is cut.
        """
        super().__init__()
        self._corners = corners
        self._starts = [np.concatenate([[0], np.cumsum(d)]) for d in divisions]
        self._numbers: dict[Corner, int] = {}

    def corner(self, i: int, j: int, k: int) -> int:
        """The node at a corner."""
        along, across, up = self._starts
        return self._node((int(along[i]), int(across[j]), int(up[k])))

    def panel(self, i: Span, j: Span, k: Span, section: ShellSection) -> None:
        """Covers a plane of the lattice with shells; exactly one of i, j, k is a single plane."""
        ranges = [self._range(axis, span) for axis, span in enumerate((i, j, k))]
        fixed = next(axis for axis, r in enumerate(ranges) if len(r) == 1)
        first, second = (axis for axis in range(3) if axis != fixed)

        def node(u: int, v: int) -> int:
            place = [0, 0, 0]
            place[fixed], place[first], place[second] = ranges[fixed][0], u, v
            return self._node((place[0], place[1], place[2]))

        for u, u_next in pairwise(ranges[first]):
            for v, v_next in pairwise(ranges[second]):
                self.add_quad(
                    [node(u, v), node(u_next, v), node(u_next, v_next), node(u, v_next)], section
                )

    def member(self, start: Corner, end: Corner, section: BeamSection, up: Place = (0, 0, 1)) -> None:
        """Lays beams along the line between two corners that differ in one direction."""
        axis = next(a for a in range(3) if start[a] != end[a])
        place = [int(s[n]) for s, n in zip(self._starts, start, strict=True)]
        nodes = []
        for g in self._range(axis, (start[axis], end[axis])):
            place[axis] = g
            nodes.append(self._node((place[0], place[1], place[2])))
        for a, b in pairwise(nodes):
            self.add_beam(a, b, section, up)

    def _range(self, axis: int, span: Span) -> list[int]:
        starts = self._starts[axis]
        if isinstance(span, int):
            return [int(starts[span])]
        return list(range(int(starts[span[0]]), int(starts[span[1]]) + 1))

    def _node(self, place: Corner) -> int:
        if place not in self._numbers:
            self._numbers[place] = self.add_node(self._position(place))
        return self._numbers[place]

    def _position(self, place: Corner) -> np.ndarray:
        """Trilinear in the block's eight corners."""
        block = self._corners
        for starts, g in zip(self._starts, place, strict=True):
            i = min(int(np.searchsorted(starts, g, "right")) - 1, len(starts) - 2)
            t = (g - starts[i]) / (starts[i + 1] - starts[i])
            block = (1 - t) * block[i] + t * block[i + 1]
        return block
