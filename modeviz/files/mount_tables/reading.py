"""What a reader of mount tables has to know besides the table."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from modeviz.units import QuantityName
from modeviz.vehicle.arrays import Floats

SixRates = tuple[Floats, Floats]
"""Stiffness and damping, (6,) each, SI."""


@dataclass(frozen=True, eq=False)
class Reading:
    """How a mount table is read."""

    named: Mapping[str, str]
    """Along which of x, y and z the `NAMED` directions are in the vehicle's file."""
    note: Callable[[str], None]
    """Told what was left out, a sentence at a time."""
    units: Mapping[QuantityName, float] = field(default_factory=dict)
    """One of a quantity, in SI, of numbers whose headers say no unit; of others these must."""
    read_property: Callable[[Path], SixRates] | None = None
    """Reads the file that a line has for its rates; None: no line may have one."""
    bodies: tuple[str, ...] | None = None
    """Those of the vehicle that a table belongs to, which names them and has nothing that is not read;
    None: what mounts join is found later."""

    @property
    def is_own(self) -> bool:
        """Whether the table belongs to a vehicle folder."""
        return self.bodies is not None


def named_directions(axes: Floats) -> dict[str, str]:
    """Return along which of x, y and z of a file the directions of rates are.

    Args:
        axes: (3, 3), what turns that file's axes into ours.
    """
    ours = {"fore_aft": 0, "lateral": 1, "vertical": 2}
    return {name: "xyz"[int(np.abs(axes[row]).argmax())] for name, row in ours.items()}
