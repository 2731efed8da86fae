"""Builds the right half of a component and mirrors it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.fem.mesh import BeamSection, FiniteElementMesh, PointMass, ShellSection
from modeviz.vehicle.arrays import Floats
from pickup.sides import Place

CENTER = 1e-6
"""m: a node closer than this to y = 0 is its own mirror image."""

BRACKET_REACH = 0.22
"""m: what is connected within this distance of a mount bracket hangs on the bracket, never on the bare
sheet or rail beside it, whose local softness no real mount sees."""

MIRROR = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True, eq=False)
class Structure:
    """A whole component: its mesh, and how the left half follows from the right."""

    mesh: FiniteElementMesh
    mirror: np.ndarray
    """(n_right,): the mirror image of each of the first nodes, which are the right half's."""
    brackets: tuple[int, ...]
    """Right-hand nodes at the ends of mount brackets."""

    def node_near(self, position: Place) -> int:
        """The node that carries what is connected there: a bracket within reach, else the nearest."""
        x, y, z = np.asarray(position, float)
        distance = np.linalg.norm(self.mesh.nodes[: len(self.mirror)] - [x, abs(y), z], axis=1)
        node = int(np.argmin(distance))
        if self.brackets:
            bracket = min(self.brackets, key=lambda n: distance[n])
            node = bracket if distance[bracket] < BRACKET_REACH else node
        return int(self.mirror[node]) if y < 0 else node


class HalfMesh:
    """Collects nodes, shells, beams and masses with y ≥ 0; nothing may lie in the plane of symmetry."""

    def __init__(self) -> None:
        self.nodes: list[Floats] = []
        self._quads: list[tuple[list[int], ShellSection]] = []
        self._beams: list[tuple[list[int], BeamSection, Place]] = []
        self._masses: list[PointMass] = []
        self._brackets: list[int] = []

    def add_node(self, position: Place) -> int:
        self.nodes.append(np.array(position, float))
        return len(self.nodes) - 1

    def add_quad(self, nodes: Sequence[int], section: ShellSection) -> None:
        self._quads.append((list(nodes), section))

    def add_beam(self, start: int, end: int, section: BeamSection, up: Place) -> None:
        self._beams.append(([start, end], section, up))

    def add_bracket(self, base: int, tip: Place, section: BeamSection) -> int:
        """Returns the node at the tip of a bracket on the node `base`."""
        end = self.add_node(tip)
        self.add_beam(base, end, section, up=(0.3, 0.2, 1.0))
        return end

    def hang_mounts_on(self, *nodes: int) -> None:
        """Marks nodes as the ends of mount brackets."""
        self._brackets.extend(nodes)

    def add_mass(
        self,
        node: int,
        mass: float,
        offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
        inertia: tuple[float, float, float] = (0.0, 0.0, 0.0),
    ) -> None:
        self._masses.append(PointMass(node, mass, offset, inertia))

    def nearest(self, position: Place) -> int:
        return int(np.argmin(np.linalg.norm(np.array(self.nodes) - position, axis=1)))

    def mirrored(self) -> Structure:
        """Both halves, joined at the nodes of the plane of symmetry."""
        right = np.array(self.nodes)
        off_center = np.flatnonzero(right[:, 1] > CENTER)
        mirror = np.arange(len(right))
        mirror[off_center] = len(right) + np.arange(len(off_center))
        quads = np.array([q for q, _ in self._quads], int).reshape(-1, 4)
        beams = np.array([b for b, _, _ in self._beams], int).reshape(-1, 2)
        up = np.array([u for _, _, u in self._beams], float)
        mesh = FiniteElementMesh(
            nodes=np.vstack([right, right[off_center] * MIRROR]),
            quads=np.vstack([quads, mirror[quads]]),
            quad_sections=2 * tuple(s for _, s in self._quads),
            beams=np.vstack([beams, mirror[beams]]),
            beam_sections=2 * tuple(s for _, s, _ in self._beams),
            beam_up=np.vstack([up, up * MIRROR]),
            point_masses=(*self._masses, *(_mirrored_mass(m, mirror) for m in self._masses)),
        )
        return Structure(mesh, mirror, tuple(self._brackets))


def _mirrored_mass(mass: PointMass, mirror: np.ndarray) -> PointMass:
    x, y, z = mass.offset
    return PointMass(int(mirror[mass.node]), mass.mass, (x, -y, z), mass.inertia)
