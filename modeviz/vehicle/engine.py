"""Engines: the harmonics of torque and force by which a running one shakes the body it is part of."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modeviz.errors import Fault, FaultsError, VehicleError, check_unique
from modeviz.vehicle.arrays import Complexes, Floats, frozen, frozen_places

INLINE_ORDERS = (1.0, 2.0, 3.0)
"""Of the crank, up to which the inertia of pistons is taken; what is above is below a hundredth."""


@dataclass(frozen=True, eq=False)
class EngineOrder:
    """A harmonic of an engine: at each crank speed it has one frequency and one amplitude."""

    name: str
    """Of the load: "engine order 2"."""
    engine: str
    order: float
    """Periods in a revolution of the crank."""
    frequency_hz: Floats
    """(n_speeds,), rising: order times crank revolutions per second."""
    loads: Complexes
    """(n_speeds, 6): force x, y, z, N, and moment about x, y, z, N m, on the body, peak; phases are to
    the crank's angle."""

    def __post_init__(self) -> None:
        if not (np.isfinite(self.order) and self.order > 0):
            raise VehicleError(f"order: found {self.order}, expected more than 0")
        frozen(self, "frequency_hz", self.frequency_hz, (None,))
        f = self.frequency_hz
        if len(f) < 1 or f[0] <= 0 or (np.diff(f) <= 0).any():
            raise VehicleError("speed: expected rising values above zero")
        frozen(self, "loads", self.loads, (len(f), 6), np.complex128)

    @property
    def label(self) -> str:
        """Its name, for people."""
        return self.name

    def acts(self, frequency_hz: Floats) -> NDArray[np.bool_]:
        """Return at which frequencies the engine can run, (n_freqs,)."""
        low, high = self.frequency_hz[[0, -1]]
        return (frequency_hz >= low) & (frequency_hz <= high)

    def at(self, frequency_hz: Floats) -> Complexes:
        """Return force and moment at frequencies, (n_freqs, 6), straight between speeds.

        Zero where the engine would have to run slower or faster than it does.
        """
        f = np.asarray(frequency_hz, np.float64)
        columns = [np.interp(f, self.frequency_hz, c, left=0.0, right=0.0) for c in self.loads.T]
        return np.stack(columns, axis=-1).astype(complex)


@dataclass(frozen=True, eq=False)
class Engine:
    """An engine that runs at any of a range of speeds."""

    name: str
    body: str
    position: Floats
    """(3,), m: where its forces act."""
    speed_hz: Floats
    """(n_speeds,), rising, revolutions of the crank per second."""
    idle_hz: float
    """Revolutions per second at idle."""
    orders: tuple[EngineOrder, ...]

    def __post_init__(self) -> None:
        frozen_places(self, "position", self.position, (3,))
        frozen(self, "speed_hz", self.speed_hz, (None,))
        if not self.orders:
            raise VehicleError(f"engine {self.name!r}: has no orders, so it shakes nothing")
        check_unique(f"engine {self.name!r}: order", (f"{o.order:g}" for o in self.orders))
        lowest, highest = self.speed_hz[[0, -1]].tolist()
        if not lowest <= self.idle_hz <= highest:
            raise FaultsError(
                Fault(
                    "idle_speed",
                    f"found {60 * self.idle_hz:g} rpm, expected one of its speeds, {60 * lowest:g} to "
                    f"{60 * highest:g} rpm",
                )
            )


@dataclass(frozen=True, kw_only=True)
class InlineEngine:
    """What the pistons of an engine in line, four-stroke, firing at even intervals, do to its block.

    The force of each along its cylinder is m r ω² (cos θ + λ cos 2θ), its moment about the crank
    ½ m r² ω² (-½ λ sin θ + sin 2θ + 3/2 λ sin 3θ); the gas takes a sine of the firing order from that
    (J. P. Den Hartog, "Mechanical Vibrations", section 5.2). Of a crank that is even in itself, as of
    four or six cylinders; the pitching of three or five is not in it.
    """

    cylinders: int
    stroke: float
    """2 r, m."""
    rod_ratio: float
    """λ = r/l: of the crank's radius to the length of the rod."""
    reciprocating_mass: float
    """m, kg, of each cylinder."""
    firing_torque: float = 0.0
    """N m, peak: of the gas at the firing order, at all speeds."""

    def __post_init__(self) -> None:
        if not 1 <= self.cylinders <= 16:
            raise FaultsError(Fault("cylinders", f"found {self.cylinders}, expected 1 to 16"))
        for name in ("stroke", "rod_ratio", "reciprocating_mass"):
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise FaultsError(Fault(name, f"found {getattr(self, name)}, expected more than 0"))
        if not self.rod_ratio < 1:
            raise FaultsError(Fault("rod_ratio", f"found {self.rod_ratio}, expected less than 1"))

    def loads(self, speed_hz: Floats, crank: Floats, cylinder: Floats) -> dict[float, Complexes]:
        """Return force and moment, (n_speeds, 6) of each order that there is.

        Args:
            speed_hz: (n_speeds,), revolutions of the crank per second.
            crank: (3,), the unit vector about which it turns.
            cylinder: (3,), the unit vector from the crank along the cylinders.
        """
        inertia = self.reciprocating_mass * (self.stroke / 2) * (2 * np.pi * speed_hz) ** 2
        r, ratio = self.stroke / 2, self.rod_ratio
        force = {1.0: 1.0, 2.0: ratio}
        moment = {1.0: -ratio / 4, 2.0: 0.5, 3.0: 0.75 * ratio}
        found: dict[float, Complexes] = {}
        for order in INLINE_ORDERS:
            phases = np.exp(1j * order * self._phases()).sum()
            along = force.get(order, 0.0) * phases * inertia
            about = -1j * moment[order] * phases * inertia * r
            if abs(phases) > 1e-9:
                found[order] = (
                    along[:, None] * np.r_[cylinder, 0, 0, 0] + about[:, None] * np.r_[0, 0, 0, crank]
                )
        if self.firing_torque:
            firing = self.cylinders / 2
            gas = 1j * self.firing_torque * np.ones((len(speed_hz), 1)) * np.r_[0, 0, 0, crank]
            found[firing] = found.get(firing, 0.0) + gas
        return dict(sorted(found.items()))

    def _phases(self) -> Floats:
        """How much earlier than the first each cylinder fires, in angles of the crank."""
        return np.arange(self.cylinders, dtype=np.float64) * (4 * np.pi / self.cylinders)
