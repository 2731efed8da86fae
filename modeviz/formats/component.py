"""What every reader returns: a structure as another program's files have it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from modeviz.errors import VehicleError
from modeviz.fem.matrices import Matrices
from modeviz.formats.node_sets import NodeSet
from modeviz.units import UNITS, QuantityName
from modeviz.vehicle.arrays import Array, Floats

ElementKind = Literal["line", "triangle", "quad", "tetra", "pyramid", "wedge", "hexa"]

CORNERS: Mapping[ElementKind, int] = {
    "line": 2, "triangle": 3, "quad": 4, "tetra": 4, "pyramid": 5, "wedge": 6, "hexa": 8,
}  # fmt: skip
"""How many corners an element has; nodes between them are left out."""


LARGEST = 1e15
"""Of all numbers, and of modal masses one over the least: no file has such in any units."""


@dataclass(frozen=True)
class UnitSystem:
    """The units in which a program computed; time is in seconds in all."""

    name: str
    """As `--units` has it, or as a file says."""
    length: float
    """m of one."""
    mass: float
    """kg of one."""

    @property
    def factors(self) -> Mapping[QuantityName, float]:
        """One of each quantity that mounts have, in SI; angles are in radians."""
        k, length = self.mass, self.length  # N/m of one, as seconds are the same in all
        return {
            "length": length,
            "stiffness": k,
            "damping": k,
            "rotational_stiffness": k * length**2,
            "rotational_damping": k * length**2,
        }


def _system(name: str, length: str, mass: str) -> UnitSystem:
    return UnitSystem(name, UNITS["length"][length], UNITS["mass"][mass])


UNIT_SYSTEMS = {
    system.name: system
    for system in (
        _system("m-kg-s", "m", "kg"),
        _system("mm-t-s", "mm", "t"),
        _system("mm-kg-mN", "mm", "kg"),
        _system("in-lbf-s", "in", "lbf s²/in"),
        _system("ft-lbf-s", "ft", "slug"),
    )
}
"""By name: those in which modes are usually computed."""


@dataclass(frozen=True, eq=False)
class Modes:
    """Natural modes in the basic coordinates, in the file's units and as it has them normalised."""

    frequency_hz: Floats
    """(n_modes,), zero or a little off it for rigid ones, below zero where ω² is: an unstable mode."""
    modal_mass: Floats
    """(n_modes,), not a number where the file does not say it."""
    damping_ratio: Floats
    """(n_modes,), not a number where the file does not say it."""
    shapes: Array
    """(n_nodes, 6, n_modes), real or complex: motions, and rotations or zeros."""
    n_residuals: int = 0
    """How many of the last are residual vectors, used like more modes, as far as files say so."""


@dataclass(frozen=True, eq=False)
class Component:
    """A structure in the basic coordinates and the units of its files."""

    node_ids: Array
    """(n_nodes,), rising."""
    nodes: Floats
    """(n_nodes, 3); not numbers where only a motion is known of a node."""
    elements: Mapping[ElementKind, Array]
    """By kind (n_elements, n_corners), rows of `nodes`."""
    modes: Modes
    units: UnitSystem | None = None
    """None: the files do not say."""
    notes: tuple[str, ...] = ()
    """What was left out or taken otherwise than it stands, a sentence each."""
    matrices: Matrices | None = field(default=None, kw_only=True)
    """Mass and stiffness in the units of the files, of which `solving` makes modes; None: unknown."""
    axes: Floats | None = field(default=None, kw_only=True)
    """(n_nodes, 3, 3), columns are what matrices take for its x, y, z; None: the basic ones."""
    source: str = field(default="", kw_only=True)
    """The files, to say so."""
    node_sets: Mapping[str, NodeSet] = field(default_factory=dict, kw_only=True)
    """Sets of its nodes that carry a point, by name: "RBE2:901"."""

    def __post_init__(self) -> None:
        check_range("the shapes", self.modes.shapes)
        check_range("the frequencies", self.modes.frequency_hz)
        check_range("the places of nodes", self.nodes[self.has_place])
        if len(repeated := _repeated(self.node_ids)):
            raise VehicleError(f"node {repeated[0]} is there twice")

    @property
    def n_modes(self) -> int:
        """How many modes it has."""
        return len(self.modes.frequency_hz)

    @property
    def is_complex(self) -> bool:
        """Whether its shapes are complex."""
        return np.iscomplexobj(self.modes.shapes)

    @property
    def has_place(self) -> Array:
        """Whether each node has a place, (n_nodes,)."""
        return np.asarray(np.isfinite(self.nodes).all(axis=1))

    def turn(self, rows: Array) -> bool:
        """Return whether all of some nodes turn in a mode, or can; those of solids do not."""
        if self.matrices is not None:
            return bool(self.matrices.turns[rows].all())
        return bool(self.modes.shapes[rows, 3:].any(axis=(1, 2)).all())

    def rows(self, ids: Array) -> Array:
        """Return the rows of nodes of those ids; raises VehicleError for one that is not there."""
        return rows_of(self.node_ids, ids)


def rows_of(node_ids: Array, ids: Array) -> Array:
    """Return where ids stand among rising ones.

    Raises:
        VehicleError: one is not among them.
    """
    rows: Array = np.searchsorted(node_ids, np.asarray(ids))
    there: Array = rows < len(node_ids)
    there[there] = node_ids[rows[there]] == ids[there]
    if not there.all():
        raise VehicleError(f"node {ids[~there].flat[0]} is named, but it is not there")
    return rows


def check_range(what: str, numbers: Array) -> None:
    """Checks that numbers are finite and not beyond `LARGEST`; no copy is made of them.

    Args:
        what: they are, in the plural.
        numbers: real or complex, as many as there are.

    Raises:
        VehicleError: they are not.
    """
    parts = (np.real(numbers), np.imag(numbers)) if np.iscomplexobj(numbers) else (numbers,)
    ends = [end for part in parts for end in (part.max(initial=0), -part.min(initial=0))]
    if not np.max(ends) < LARGEST:
        raise VehicleError(f"{what} have values that are not finite numbers, or beyond {LARGEST:g}")


def _repeated(rising: Array) -> Array:
    return rising[1:][rising[1:] == rising[:-1]]
