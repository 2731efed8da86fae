"""Bodies that are spoken of together: the cab with its front end, an axle's wheels.

Nothing here knows a particular vehicle: bodies enter by their role, wheels by their tyres.
"""

from dataclasses import dataclass

from modeviz.vehicle.bodies import Body, Role
from modeviz.vehicle.vehicle import Vehicle

AXLE_LENGTH = 0.3
"""m: wheel centres nearer than this along x are of one axle."""


@dataclass(frozen=True, eq=False)
class Unit:
    """Bodies that are spoken of as one."""

    word: str
    bodies: tuple[Body, ...]

    @property
    def as_one(self) -> tuple[tuple[Body, ...], ...]:
        """The bodies that turn about a common centre; each of an axle's wheels has its own."""
        if self.bodies[0].role == "unsprung":
            return tuple((body,) for body in self.bodies)
        return (self.bodies,)


@dataclass(frozen=True, eq=False)
class Axle:
    """The wheels at one station."""

    word: str
    """"front", "axle 2", "rear"; "wheel" where there is one axle."""
    x: float
    """m."""
    wheels: tuple[Body, ...]
    """The bodies that carry its tyres: one if it is rigid."""

    @property
    def unit(self) -> Unit:
        if len(self.wheels) == 1:
            return Unit(self.wheels[0].label, self.wheels)
        return Unit("wheels" if self.word == "wheel" else f"{self.word} wheels", self.wheels)


def unit_of_role(vehicle: Vehicle, role: Role) -> Unit | None:
    """The bodies of a role as one unit, called after the one with most modes or mass."""
    bodies = tuple(b for b in vehicle.bodies if b.role == role)
    if not bodies:
        return None
    return Unit(max(bodies, key=lambda body: body.mass).label, bodies)


def units(vehicle: Vehicle) -> tuple[Unit, ...]:
    """Every body in one unit: roles that move as one, axles, and the rest by themselves."""
    together: tuple[Role, ...] = ("cabin", "frame", "bed", "powertrain")
    of_roles = [unit for role in together if (unit := unit_of_role(vehicle, role))]
    joined = [*of_roles, *(axle.unit for axle in axles(vehicle))]
    taken = {b.name for unit in joined for b in unit.bodies}
    return (*joined, *(Unit(b.label, (b,)) for b in vehicle.bodies if b.name not in taken))


def axles(vehicle: Vehicle) -> tuple[Axle, ...]:
    """The axles, front to rear."""
    carriers: dict[float, list[Body]] = {}
    for tyre in sorted(vehicle.tyres, key=lambda t: t.wheel_center[0]):
        x = float(tyre.wheel_center[0])
        station = next((s for s in carriers if abs(s - x) < AXLE_LENGTH), x)
        wheels = carriers.setdefault(station, [])
        wheel = vehicle.body(tyre.bodies[0])
        if wheel not in wheels:
            wheels.append(wheel)
    words = _axle_words(len(carriers))
    return tuple(Axle(w, x, tuple(b)) for w, (x, b) in zip(words, carriers.items(), strict=True))


def _axle_words(n_axles: int) -> list[str]:
    if n_axles < 2:
        return ["wheel"] * n_axles
    return ["front", *(f"axle {i}" for i in range(2, n_axles)), "rear"]
