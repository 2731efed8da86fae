"""A vehicle of any size: flexible wagons in a row, joined by mounts, each on four tyres."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Attachment, FlexibleBody
from modeviz.vehicle.connections import GROUND, Mount, Tyre
from modeviz.vehicle.loads import ResponsePoint, Road
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle

LENGTH, WIDTH = 2.0, 1.6
"""m, of a wagon."""

MASS = 500.0
"""kg, of a wagon."""

GYRATION = 0.1
"""m: of the lumps that a wagon's mass is in."""

FIRST_HZ, STEP_HZ = 15.0, 8.0
"""The elastic modes of a free wagon: a plate has about as many in one band as in the next."""

RATES = MountRates(vertical=4e5, lateral=2e5, fore_aft=2e5)


@dataclass(frozen=True)
class Size:
    """How large a vehicle is."""

    n_wagons: int
    n_modes: int
    """Of each wagon, rigid ones included."""
    n_mounts: int
    """Between two wagons."""


def scaled_vehicle(size: Size, seed: int = 0) -> Vehicle:
    """A vehicle with n_wagons × n_modes coordinates and 3 (n_wagons - 1) n_mounts mount springs.

    It has one mount group for each coupling, four response points and a road, like the pickup.
    """
    rng = np.random.default_rng(seed)
    wagons = [_wagon(i, size, rng) for i in range(size.n_wagons)]
    return Vehicle(
        "road train",
        tuple(wagons),
        tuple(tyre for wagon in wagons for tyre in _tyres(wagon)),
        mount_groups=tuple(_coupling(*pair) for pair in pairwise(wagons)),
        response_points=tuple(
            ResponsePoint(a.name, wagons[0].name, a.position) for a in _named(wagons[0], "wheel")
        ),
        roads=(_road(),),
    )


def _wagon(number: int, size: Size, rng: np.random.Generator) -> FlexibleBody:
    """A free body of lumps; its elastic modes are random, mass-normalised and free of rigid motion."""
    places = _places(number * LENGTH, size.n_mounts)
    n_lumps = max(len(places), -(-size.n_modes // 6))
    low = np.array([number * LENGTH, -WIDTH / 2, 0.6])
    inside = low + rng.uniform(0.0, [LENGTH, WIDTH, 0.4], (n_lumps - len(places), 3))
    nodes = np.vstack([*places.values(), *inside])
    lump = MASS / n_lumps * np.tile([1.0, 1.0, 1.0] + 3 * [GYRATION**2], n_lumps)
    rigid = rigid_motions(nodes - nodes.mean(axis=0)).reshape(-1, 6)
    elastic = rng.normal(size=(6 * n_lumps, size.n_modes - 6))
    # In the metric of the mass, QR makes each column orthogonal to those before it.
    weighted, _ = np.linalg.qr(np.hstack([np.sqrt(lump)[:, None] * rigid, elastic]))
    shapes = (weighted / np.sqrt(lump)[:, None]).reshape(n_lumps, 6, size.n_modes)
    omega_n = 2 * np.pi * (FIRST_HZ + STEP_HZ * np.arange(size.n_modes - 6))
    attachments = tuple(
        Attachment(name, position, shapes[i]) for i, (name, position) in enumerate(places.items())
    )
    return FlexibleBody(
        name=f"wagon {number + 1}",
        role="frame" if number else "cabin",
        label=f"wagon {number + 1}",
        omega_n_squared=np.r_[np.zeros(6), omega_n**2],
        n_residuals=0,
        damping_ratio=0.02,
        attachments=attachments,
        nodes=nodes,
        shapes=shapes,
    )


def _places(front: float, n_mounts: int) -> dict[str, Floats]:
    """Where wheels and mounts hold on to a wagon whose front end is at x = `front`."""
    wheels = {
        f"wheel {x:g} {y:g}": np.array([front + x, y, 0.3])
        for x in (0.25 * LENGTH, 0.75 * LENGTH)
        for y in (-WIDTH / 2, WIDTH / 2)
    }
    across = np.linspace(-WIDTH / 2, WIDTH / 2, n_mounts)
    mounts = {
        f"{end} {i + 1}": np.array([front + x, across[i], 0.8])
        for end, x in (("front", 0.0), ("rear", LENGTH))
        for i in range(n_mounts)
    }
    return wheels | mounts


def _named(wagon: FlexibleBody, kind: str) -> list[Attachment]:
    return [a for a in wagon.attachments if a.name.startswith(kind)]


def _tyres(wagon: FlexibleBody) -> list[Tyre]:
    return [
        Tyre(
            f"{wagon.name} {wheel.name}",
            "tyres",
            (wagon.name, GROUND),
            np.stack([wheel.position, wheel.position]),
            stiffness=np.array([5e4, 5e4, 2e5]),
            damping=np.array([500.0, 500.0, 2e3]),
            loss_factor=0.05,
            wheel_center=wheel.position,
        )
        for wheel in _named(wagon, "wheel")
    ]


def _coupling(front: FlexibleBody, rear: FlexibleBody) -> MountGroup:
    """The mounts that join the rear end of a wagon to the front end of the next."""
    mounts = tuple(
        Mount(
            f"{front.name} {a.name}",
            "",
            (front.name, rear.name),
            np.stack([a.position, b.position]),
        )
        for a, b in zip(_named(front, "rear"), _named(rear, "front"), strict=True)
    )
    low, high = (MountRates(*(factor * rate for rate in RATES.as_tuple())) for factor in (0.25, 3.0))
    name = f"{front.name} to {rear.name}"
    return MountGroup(name, name, RATES, 0.1, (low, high), mounts)


def _road() -> Road:
    """Two tracks with power falling as f⁻², half coherent."""
    f = np.geomspace(0.02, 100.0, 50)
    spectrum = 1e-6 * f[:, None, None] ** -2 * np.array([[1.0, 0.5], [0.5, 1.0]])
    return Road("road", "Road", 20.0, f, spectrum.astype(complex))
