"""Mounts that are tuned together, because they are the same part."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from modeviz.errors import VehicleError, unknown
from modeviz.units import si_unit
from modeviz.vehicle.arrays import Floats, frozen
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.dynamic_rates import DynamicRates
from modeviz.vehicle.mount_rates import (
    DIRECTIONS,
    OTHER_FIELDS,
    RATE_NAMES,
    RATE_QUANTITIES,
    ROTATIONAL_FIELDS,
    Bounds,
    MountRates,
    check_bounds,
    spoken_rate,
    tuned_fields,
)
from modeviz.vehicle.progressive import ForceCurve

USUAL_STATIC_RATIO = 1.3
"""How many times as stiff rubber is when it vibrates as under a load that stays, if nothing is said."""

Travel = Mapping[str, tuple[float, float]]
"""The least and the most deflection, m, by one of `DIRECTIONS`; positive along the local axis."""

PartKind = Literal["mount", "spring", "damper", "dashpot", "inerter"]
"""A dashpot resists velocity with its rates and an inerter acceleration, all else displacement."""

SHARED = ("rotational_stiffness", "damping", "rotational_damping")
"""What a mount has from its group unless it has its own."""


@dataclass(frozen=True, eq=False)
class MountGroup:
    """Mounts that are tuned together, because they are the same part."""

    name: str
    """Short, "C1"."""
    label: str
    """What a person calls it, "cab front"."""
    rates: MountRates
    loss_factor: float
    bounds: Bounds
    """The softest and the stiffest that can be made; what is the same in both is not tuned."""
    mounts: tuple[Mount, ...]
    """Where they are; their stiffness is the group's."""
    ratio_limits: tuple[float, float] | None = None
    """The least and the most that lateral and fore-aft rates may be of the vertical one."""
    rotational_stiffness: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,) about the local x, y, z of each mount that has none of its own, N m/rad; not tuned, as what
    follows, and zero where the rates have what is."""
    damping: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,) viscous, along its axes, likewise, N s/m."""
    rotational_damping: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,) viscous, about its axes, likewise, N m s/rad."""
    static_ratio: float = USUAL_STATIC_RATIO
    """Its rates by those under a load that stays."""
    travel: Travel = field(default_factory=dict)
    """How far its first end may go from its second, m, the least and the most, by direction."""
    curves: Mapping[str, ForceCurve] = field(default_factory=dict)
    """By direction, where a mount is progressive; each is scaled so that unloaded it has the group's
    rate by its static ratio."""
    dynamic: DynamicRates | None = None
    """How the rates along the axes of each depend on frequency; None: not at all."""
    kind: PartKind = "mount"
    """What they are: a file has springs and dampers in tables of their own, see `tuned_group`; dashpots
    and inerters have no rates, and are there for derivatives to these alone."""

    def __post_init__(self) -> None:
        for name in SHARED:
            frozen(self, name, getattr(self, name), (3,))
        self._check_static()
        if not self.mounts:
            raise VehicleError(f"{self._words}: has no mounts")
        if any(r.loss_factor is not None for r in (self.rates, *self.bounds)):
            raise VehicleError(
                f"{self._words}: found a loss factor in its rates or bounds, expected it "
                "as the group's own"
            )
        check_bounds(self._words, self.bounds)
        if not self.fields:
            raise VehicleError(
                f"{self._words}: bounds: found the same softest and stiffest rates, "
                "expected some that differ; what is not tuned is a [[spring]] or a [[damper]]"
            )
        self._check_shared()
        if self.ratio_limits is not None and not 0 <= self.ratio_limits[0] < self.ratio_limits[1]:
            raise VehicleError(
                f"{self._words}: ratio_limits: found {self.ratio_limits}, expected the lower one first"
            )
        object.__setattr__(self, "mounts", tuple(map(self._tuned, self.mounts)))

    def _check_static(self) -> None:
        """Raises VehicleError for a ratio or a travel that no mount has."""
        where = self._words
        if not (np.isfinite(self.static_ratio) and self.static_ratio > 0):
            raise VehicleError(
                f"{where}: static_ratio: found {self.static_ratio:g}, expected more than zero"
            )
        for what, directions in (("travel", self.travel), ("curve", self.curves)):
            for direction in directions:
                if direction not in DIRECTIONS:
                    words = unknown("direction", direction, DIRECTIONS)
                    raise VehicleError(f"{where}: {what}: {words}")
        for direction, (least, most) in self.travel.items():
            if not least <= 0 <= most or least == most:
                raise VehicleError(
                    f"{where}: travel: {direction}: found {1e3 * least:g} to {1e3 * most:g} mm, "
                    "expected the least first, zero or below, and the most, zero or above"
                )

    def _check_shared(self) -> None:
        """Raises VehicleError where a rate is in the wrong place, or in two."""
        shared = *self.rotational_stiffness, *self.damping[::-1]
        for name, rate in zip(OTHER_FIELDS, shared, strict=True):
            attribute = "rotational_stiffness" if name in ROTATIONAL_FIELDS else "damping"
            if rate and name in self.fields:
                raise VehicleError(
                    f"{self._words}: {attribute}: found beside {RATE_NAMES[name]} among "
                    "its rates, expected one of them"
                )
        self._check_tuned(self.rates, "; any other belongs into rotational_stiffness or damping")

    def _check_tuned(self, rates: MountRates, otherwise: str = "") -> None:
        """Raises VehicleError for a rate about an axis, or damping, that is not tuned."""
        for name in OTHER_FIELDS:
            if getattr(rates, name) and name not in self.fields:
                raise VehicleError(
                    f"{self._words}: {RATE_NAMES[name]}: found {spoken_rate(rates, name)}, "
                    f"expected a rate that is tuned, whose softest and stiffest differ{otherwise}"
                )

    @property
    def _words(self) -> str:
        """What an error calls it."""
        return f"{self.kind} group {self.name!r}"

    @property
    def fields(self) -> tuple[str, ...]:
        """Those of `RATE_FIELDS` that are tuned."""
        return tuned_fields(self.bounds)

    @property
    def meaning(self) -> str:
        """The label where it says more than the name, else ""."""
        return "" if self.label == self.name else self.label

    @property
    def title(self) -> str:
        """Name and label: "C1  cab front"; once what is the same."""
        return f"{self.name}  {self.meaning}".rstrip()

    def _tuned(self, mount: Mount) -> Mount:
        """A mount with what its group has, and its own where it has that."""
        values = {
            "rotational_stiffness": self.rotational_stiffness + self.rates.rotational(),
            "damping": self.damping + self.rates.damping(),
            "rotational_damping": self.rotational_damping,
        }
        given = {name: value for name, value in values.items() if not mount.has_own(name)}
        return replace(
            mount,
            group=self.name,
            stiffness=mount.tangent * self.rates.local(),
            loss_factor=self.loss_factor,
            given=given,
            **given,
        )

    def rate_of_each(self, field: str, rates: MountRates) -> float:
        """One of `RATE_FIELDS` that its mounts have with some rates, SI, whether it is tuned or not.

        Raises:
            VehicleError: they each have their own.
        """
        if field in self.fields or field not in OTHER_FIELDS:
            return getattr(rates, field)
        attribute = "rotational_stiffness" if field in ROTATIONAL_FIELDS else "damping"
        axis = (
            OTHER_FIELDS.index(field) if field in ROTATIONAL_FIELDS else 5 - OTHER_FIELDS.index(field)
        )
        found = {float(getattr(mount, attribute)[axis]) for mount in self.mounts}
        if len(found) > 1:
            raise VehicleError(
                f"the mounts of {self.name!r} each have their own, from {min(found):g} to "
                f"{max(found):g} {si_unit(RATE_QUANTITIES[field])}; see their vehicle"
            )
        return found.pop()

    def loss_factor_with(self, rates: MountRates) -> float:
        """The loss factor of the group with other rates."""
        return self.loss_factor if rates.loss_factor is None else rates.loss_factor

    def plain(self, rates: MountRates) -> MountRates:
        """The rates with a loss factor only if it is not the group's own.

        Raises:
            VehicleError: a rate about an axis, or damping, that is not tuned.
        """
        self._check_tuned(rates)
        is_own = rates.loss_factor == self.loss_factor
        return replace(rates, loss_factor=None) if is_own else rates

    def with_rates(self, rates: MountRates) -> "MountGroup":
        """The group with other rates; a loss factor among them becomes its own.

        Raises:
            VehicleError: a rate about an axis, or damping, that is not tuned.
        """
        loss_factor = self.loss_factor_with(rates)
        return replace(self, rates=replace(rates, loss_factor=None), loss_factor=loss_factor)
