"""A tuned absorber: a small mass on a spring at a point of a body, which takes motion out of a mode."""

from dataclasses import dataclass, replace

import numpy as np

from modeviz.errors import VehicleError
from modeviz.vehicle.absorber_names import guide_name, mass_name
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import GROUND
from modeviz.vehicle.local_axes import TurnOrder, angles_of_axes, axes_of_angles
from modeviz.vehicle.mount_rates import USUAL_RANGE, check_directions
from modeviz.vehicle.placement import Placement


@dataclass(frozen=True)
class Absorber:
    """A mass on a spring at a point of a body."""

    name: str
    """Also that of its mount and its mount group."""
    body: str
    """What it sits on."""
    position: tuple[float, float, float]
    """m; on a flexible body an attachment must be near."""
    mass: float
    """kg."""
    frequency_hz: float
    """Of the mass on its spring, were the body still: the spring is m (2πf)²."""
    damping_ratio: float = 0.0
    """Viscous, a fraction of critical at that frequency: 2ζ m 2πf."""
    loss_factor: float = 0.0
    """Of the spring, besides."""
    directions: tuple[str, ...] = ("vertical",)
    """Of `DIRECTIONS`: those of the vehicle along which it moves; along all others it goes along."""
    angles: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """rad, about x, then y, then z, by which these are turned out of the vehicle's."""
    frequency_range: tuple[float, float] | None = None
    """Hz, the lowest and the highest to which it can be tuned; None: half its own, and twice it."""
    damping_range: tuple[float, float] | None = None
    """The lowest and the highest damping ratio, at its frequency; None: a quarter of its own, and four
    times it."""

    def __post_init__(self) -> None:
        where = f"absorber {self.name!r}"
        for key in ("position", "angles"):
            value = tuple(map(float, getattr(self, key)))
            if len(value) != 3 or not np.isfinite(value).all():
                raise VehicleError(f"{where}: {key}: found {value}, expected three numbers")
            object.__setattr__(self, key, value)
        for key, unit in (("mass", " kg"), ("frequency_hz", " Hz")):
            value = getattr(self, key)
            if not (np.isfinite(value) and value > 0):
                raise VehicleError(f"{where}: {key}: found {value}{unit}, expected more than 0")
        for key in ("damping_ratio", "loss_factor"):
            value = getattr(self, key)
            if not (np.isfinite(value) and value >= 0):
                raise VehicleError(f"{where}: {key}: found {value}, expected zero or more")
        if self.body == GROUND:
            raise VehicleError(f"{where}: body: found {GROUND!r}, expected a body, which moves")
        check_directions(where, self.directions)
        low, high = self.tuned_hz
        if not (0 <= low < high < np.inf):
            raise VehicleError(
                f"{where}: frequency_range: found {low:g} to {high:g} Hz, expected the lower one first"
            )
        low, high = self.tuned_damping_ratio
        if not (0 <= low <= high < np.inf):
            raise VehicleError(
                f"{where}: damping_range: found {low:g} to {high:g}, expected the lower one first"
            )

    @property
    def tuned_hz(self) -> tuple[float, float]:
        """Hz, the lowest and the highest to which it can be tuned."""
        return self.frequency_range or (self.frequency_hz / 2, 2 * self.frequency_hz)

    @property
    def tuned_damping_ratio(self) -> tuple[float, float]:
        """The lowest and the highest damping ratio to which it can be tuned."""
        own = self.damping_ratio
        return self.damping_range or (own / USUAL_RANGE, USUAL_RANGE * own)

    def stiffness_at(self, frequency_hz: float) -> float:
        """M (2πf)², N/m: the spring with which it has a frequency."""
        return self.mass * (2 * np.pi * frequency_hz) ** 2

    @property
    def damping(self) -> float:
        """N s/m, along each of its directions."""
        return self.damping_with(self.damping_ratio)

    def damping_with(self, damping_ratio: float) -> float:
        """2ζ m 2πf, N s/m: the damper with which it has a damping ratio."""
        return 2 * damping_ratio * self.mass * 2 * np.pi * self.frequency_hz

    @property
    def axes(self) -> Floats:
        """The axes of its directions as rows, (3, 3)."""
        return axes_of_angles(np.array(self.angles), TurnOrder())

    def placed(self, placement: Placement) -> "Absorber":
        """Return it moved and turned as a mount is."""
        position = np.add(self.position, placement.offset)
        axes = self.axes @ axes_of_angles(np.array(placement.angles), TurnOrder())
        x, y, z = angles_of_axes(axes).tolist()
        return replace(self, position=tuple(position.tolist()), angles=(x, y, z))

    @property
    def body_name(self) -> str:
        """What its mass is called among the bodies."""
        return mass_name(self.name)

    @property
    def guide_name(self) -> str:
        """What the joint that guides it is called among the connections."""
        return guide_name(self.name)


@dataclass(frozen=True)
class Tuning:
    """The frequency and the damping of an absorber."""

    frequency_hz: float
    damping_ratio: float


def den_hartog(mass_ratio: float, frequency_hz: float) -> Tuning:
    """Return the tuning that leaves the least peak of an undamped mode under a harmonic force.

    f = f₀/(1 + μ), and c = 2 m 2πf₀ √(3μ/(8 (1 + μ)³)), which as a fraction of what is critical at f
    is ζ = √(3μ/(8 (1 + μ))). (J. P. Den Hartog, "Mechanical Vibrations", 4th ed., section 3.3.)

    Args:
        mass_ratio: of the absorber's mass to the mode's effective mass where it sits.
        frequency_hz: of the mode.
    """
    ratio = 1 + mass_ratio
    return Tuning(frequency_hz / ratio, float(np.sqrt(3 * mass_ratio / (8 * ratio))))
