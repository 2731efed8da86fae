"""A connection as a file of another program has it: what every reader of mounts returns."""

from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from modeviz.files.mount_tables.limits import GroupLimits
from modeviz.vehicle.arrays import Floats, frozen
from modeviz.vehicle.local_axes import AXES
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.pose import Pose

DIRECTIONS = (*AXES, *(f"r{axis}" for axis in AXES))
"""Of a bushing: along its axes, then about them."""


@dataclass(frozen=True, eq=False)
class End:
    """Where a bushing holds on, as far as its file says it: a body, an attachment, or a place."""

    where: str
    """In the file, to say so: "line 3, column body 1"."""
    body: str = ""
    """Its name, or `GROUND`; empty if the file names none."""
    attachment: str = ""
    """The name of a body's attachment; empty if the file names none."""
    place: Floats | None = None
    """(3,), m, in the vehicle file's axes."""
    may_be_elsewhere: bool = False
    """Whether the attachment is only likely called so, and else the nearest one to the place."""


@dataclass(frozen=True, eq=False)
class Bushing:
    """Springs and dampers in six directions, in SI and the axes of the vehicle's file."""

    where: str
    """In the file, to say so: "line 3", "CBUSH 7"."""
    name: str
    ends: tuple[End, End]
    group: str | None = None
    """The mount group that it is one of; None: it is not tuned."""
    stiffness: Floats = field(default_factory=lambda: np.zeros(6))
    """(6,) of `DIRECTIONS`, N/m and N m/rad."""
    damping: Floats = field(default_factory=lambda: np.zeros(6))
    """(6,), N s/m and N m s/rad."""
    loss_factor: float = 0.0
    softest: Floats = field(default_factory=lambda: np.full(3, np.nan))
    """(3,), N/m: along x, y, z, the least that can be made; not a number where it is not known."""
    stiffest: Floats = field(default_factory=lambda: np.full(3, np.nan))
    axes: Floats = field(default_factory=lambda: np.eye(3))
    """(3, 3): the local axes as rows."""
    rigid: tuple[str, ...] = ()
    """Which of `DIRECTIONS` there is no motion in."""
    elastic_center: float = 0.5
    limits: GroupLimits = field(default_factory=GroupLimits)
    """What is said of its group beside rates."""
    acts_at: Floats | None = None
    """(3,), m: where it acts if that is not between its ends; rigid arms go there."""

    def __post_init__(self) -> None:
        frozen(self, "stiffness", self.stiffness, (6,))
        frozen(self, "damping", self.damping, (6,))
        frozen(self, "axes", self.axes, (3, 3))

    @property
    def others(self) -> Floats:
        """Rates about its axes and of its dampers along them, (6,) of `limits.OTHERS`."""
        return np.concatenate([self.stiffness[3:], self.damping[:3]])

    @property
    def is_tuned(self) -> bool:
        """Whether it is one of a group that has something to tune."""
        tuned = self.stiffness[:3].any() or not np.isnan(self.limits.others).all()
        return bool(self.group and tuned and not self.rigid)

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """The softest and the stiffest rates along x, y, z, (3,) each, the usual ones if not given."""
        if not self.stiffness[:3].any() and np.isnan([self.softest, self.stiffest]).all():
            return np.zeros(3), np.zeros(3)
        usual = usual_bounds(MountRates(*self.stiffness[:3]))  # three numbers, whatever they are called
        low, high = (
            np.where(np.isnan(bound), other.as_tuple(), bound)
            for bound, other in zip((self.softest, self.stiffest), usual, strict=True)
        )
        return low, high

    def moved(self, pose: Pose) -> Self:
        """Return the bushing in the vehicle that is in the coordinates of a component."""
        first, second = (
            end if end.place is None else replace(end, place=pose.places(end.place))
            for end in self.ends
        )
        return replace(
            self,
            ends=(first, second),
            axes=self.axes @ pose.rotation.T,
            acts_at=None if self.acts_at is None else pose.places(self.acts_at),
        )
