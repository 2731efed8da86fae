"""One mount without rates beside another, which tells what placing that one otherwise would do."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from modeviz.optimise.place_variables import Kind, PlaceVariable
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.local_axes import AXES
from modeviz.vehicle.mount_group import SHARED, MountGroup, PartKind
from modeviz.vehicle.mount_rates import (
    DAMPING_FIELDS,
    RATE_FIELDS,
    ROTATIONAL_FIELDS,
    STIFFNESS_FIELDS,
    MountRates,
)
from modeviz.vehicle.placement import Placement, Placements

STEP = 1e-5
"""M: so far from a mount its probes are; any distance would do on rigid bodies."""

QUARTER, EIGHTH = np.pi / 2, np.pi / 4


@dataclass(frozen=True)
class Shift:
    """How far from a place a probe is, and what its rows count."""

    step: float
    """m or rad."""
    square: float
    """w of what is quadratic in rows, 1/m or 1/rad."""
    linear: float
    """Likewise of what is linear in them."""


SHIFTS: dict[Kind, tuple[Shift, ...]] = {
    "offset": tuple(Shift(s * STEP, s / (2 * STEP), s / (2 * STEP)) for s in (1, -1)),
    "angles": tuple(
        shift
        for s in (1, -1)
        for shift in (Shift(s * EIGHTH, s, 0.0), Shift(s * QUARTER, s * (1 - np.sqrt(2)) / 2, s / 2))
    ),
}

READ: dict[str, tuple[str, int]] = {
    **{field: ("stiffness", axis) for axis, field in enumerate(reversed(STIFFNESS_FIELDS))},
    **{field: ("rotational_stiffness", axis) for axis, field in enumerate(ROTATIONAL_FIELDS)},
    **{field: ("damping", axis) for axis, field in enumerate(reversed(DAMPING_FIELDS))},
}
"""The attribute of a mount, and which of its three numbers, that each field of `MountRates` is."""

ALONG = tuple(reversed(STIFFNESS_FIELDS))
"""The fields along a mount's x, y and z."""


def rates_of(mount: Mount) -> dict[str, float]:
    """Return all that a mount has of `RATE_FIELDS`, whether that is tuned or its own."""
    return {f: float(getattr(mount, attribute)[axis]) for f, (attribute, axis) in READ.items()}


def turning_damping(mount: Mount) -> dict[str, float]:
    """Return with what a mount damps turning about its axes, N m s/rad."""
    return dict(zip(ROTATIONAL_FIELDS, mount.rotational_damping.tolist(), strict=True))


@dataclass(frozen=True, eq=False)
class Probe:
    """A mount without rates, a group of its own, which stands for a part of what is placed.

    That part is as if it had rates that are read of the mount itself.
    """

    number: int
    """Of its place variable."""
    variable: PlaceVariable
    shift: Shift
    mount: int
    """The number of the mount that it probes, of all."""
    given: Mount
    """That mount, where it was given."""
    is_mirrored: bool
    """Whether that is on the other side than the first of its group."""
    kind: PartKind = "mount"
    """A "dashpot" stands for what damps turning, a "mount" for springs and for dampers along axes."""

    @property
    def own_name(self) -> str:
        """As no other mount or group is called."""
        part = "" if self.is_read else f", {self.kind}"
        return f"{self.given.name}, {self.variable.spoken} {self.shift.step:+g}{part}"

    @property
    def is_read(self) -> bool:
        """Whether goals that read the mount's own stretch or ends read it there."""
        return self.kind == "mount"

    def counts(self, mount: Mount) -> Mapping[str, float]:
        """Return what its rates are as if, by field of `MountRates`.

        Args:
            mount: that it probes, with its present rates.
        """
        return rates_of(mount) if self.is_read else turning_damping(mount)

    def group(self, probed: MountGroup, loss_factor: float) -> MountGroup:
        """Return it where the mount is that it probes, of that group."""
        fields = self._fields(probed)
        still = dict.fromkeys(SHARED, np.zeros(3))
        none = dict.fromkeys(STIFFNESS_FIELDS, 0.0)
        return replace(
            probed,
            name=self.own_name,
            label=self.own_name,
            mounts=(replace(self._where, name=self.own_name, given={}, tangent=np.ones(3), **still),),
            rates=MountRates(**none),
            loss_factor=loss_factor,
            bounds=(MountRates(**none), MountRates(**{**none, **dict.fromkeys(fields, 1.0)})),
            ratio_limits=None,
            curves={},
            dynamic=probed.dynamic if self.is_read else None,
            kind=self.kind,
            **still,
        )

    def placement(self, placements: Placements) -> Placement:
        """Return where it is while mounts are placed so."""
        value = self.variable.of(placements) + self.shift.step
        placed = self.variable.put(placements, value)[self.variable.group]
        return placed.mirrored if self.is_mirrored else placed

    def pull(self, gravity: Floats) -> Floats:
        """Return with what the weight of what is placed pulls along its axes, (3,), N/m or N/rad.

        Args:
            gravity: along these axes, (3,), m/s².
        """
        return 0.0 * gravity

    @property
    def _where(self) -> Mount:
        """The mount that it probes, with its ends where and on what they are probed."""
        return self.given

    def _fields(self, probed: MountGroup) -> list[str]:
        """Those of its rates to which derivatives are asked for."""
        own = self.counts(self.given)
        always = {*STIFFNESS_FIELDS, *probed.fields} if self.is_read else set()
        return [f for f in RATE_FIELDS if f in always or own.get(f)]


@dataclass(frozen=True, eq=False)
class MassProbe(Probe):
    """One that stands for the mass of an absorber where its spring is placed, see `mass_probes`."""

    ends: tuple[str, str] = ("", "")
    """Of the bodies between which it is."""
    mass: float = 0.0
    """kg: what it counts along each of its axes that `along` has."""
    inertia: float = 0.0
    """kg m²: about each axis."""
    along: tuple[str, ...] = ALONG
    has_arm: bool = False
    """Whether its first end stays and a rigid arm reaches to where it is probed."""
    weight: float = 0.0
    """kg: what is pulled along these axes by a load that stays."""

    @property
    def own_name(self) -> str:
        arm = ", on an arm" if self.has_arm else ""
        return f"{super().own_name}, {self.ends[0]} to {self.ends[1]}{arm}"

    def counts(self, mount: Mount) -> Mapping[str, float]:
        masses, inertias = dict.fromkeys(self.along, self.mass), {}
        if self.inertia:
            inertias = dict.fromkeys(ROTATIONAL_FIELDS, self.inertia)
        return masses | inertias

    def placement(self, placements: Placements) -> Placement:
        if self.has_arm:
            return placements.get(self.variable.group, Placement())
        return super().placement(placements)

    def pull(self, gravity: Floats) -> Floats:
        is_offset = self.variable.kind == "offset"
        by = self.weight * (self.shift.linear if is_offset else self.shift.square)
        return by * gravity * np.isin(ALONG, self.along)

    def _fields(self, probed: MountGroup) -> list[str]:
        return list(self.counts(self.given))

    @property
    def _where(self) -> Mount:
        points = self.given.points + self._arm
        return replace(self.given, bodies=self.ends, points=points, elastic_center=1.0)

    @property
    def _arm(self) -> Floats:
        """From its first end to where it acts, (2, 3)."""
        arm = np.zeros((2, len(AXES)))
        if self.has_arm:
            arm[1, self.variable.axis] = self.shift.step
        return arm
