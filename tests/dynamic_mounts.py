"""A block on mounts whose rubber depends on frequency, the block below it, and what shakes them."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Spring
from modeviz.vehicle.dynamic_rates import DynamicRates, HydraulicRates, RateTable, ThreeParameterRates
from modeviz.vehicle.loads import BaseMotion, Force, ResponsePoint, Spectrum
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.vehicle import Vehicle

RATES = MountRates(260e3, 180e3, 150e3)
OTHER_RATES = MountRates(190e3, 240e3, 110e3)
MAXWELL = ThreeParameterRates(reference_hz=5.0, stiffening=np.array([0.4, 0.5, 0.8]), corner_hz=9.0)
HYDRAULIC = HydraulicRates(
    reference_hz=3.0,
    rubber=200e3,
    rubber_loss=0.08,
    bulge_stiffness=150e3,
    track_mass=0.02,
    track_damping=1.2,
    area_ratio=40.0,
)


def measured(rubber: DynamicRates, n: int = 60) -> RateTable:
    """The table that a test rig would make of it."""
    f = np.linspace(0.0, 60.0, n)
    return RateTable(reference_hz=rubber.reference_hz, frequency_hz=f, rates=rubber.complex_rates(f))


def constant(loss_factor: float) -> RateTable:
    """A table of one rate."""
    f = np.array([1.0, 10.0, 50.0])
    rates = np.full((3, 3), 7.0 * (1 + 1j * loss_factor))
    return RateTable(reference_hz=8.0, frequency_hz=f, rates=rates)


def on_mounts(dynamic: DynamicRates | None, loss_factor: float | None = None) -> Vehicle:
    """The vehicle: an engine on a frame, which stands on such mounts too, on a ground that moves."""
    engine = RigidBody(
        "engine",
        "powertrain",
        "engine",
        180.0,
        np.array([0.0, 0.02, 0.9]),
        np.array([[6.0, 0.4, -0.5], [0.4, 12.0, 0.2], [-0.5, 0.2, 11.0]]),
    )
    frame = RigidBody(
        "frame", "frame", "frame", 400.0, np.array([0.1, 0.0, 0.5]), np.diag([60.0, 300.0, 320.0])
    )
    own = dynamic.loss_factor if dynamic and loss_factor is None else loss_factor or 0.1
    places = [(x, y) for x in (-0.4, 0.35) for y in (-0.3, 0.3)]
    mounts = tuple(
        Mount(f"E{i}", "E", ("engine", "frame"), np.tile([x, y, 0.7], (2, 1)))
        for i, (x, y) in enumerate(places)
    )
    feet = tuple(
        Mount(f"F{i}", "F", ("frame", GROUND), np.tile([2 * x, 2 * y, 0.3], (2, 1)))
        for i, (x, y) in enumerate(places)
    )
    foot = MountRates(400e3, 300e3, 350e3)
    groups = (
        MountGroup("E", "engine", RATES, own, usual_bounds(RATES), mounts, dynamic=dynamic),
        MountGroup("F", "feet", foot, own, usual_bounds(foot), feet, dynamic=dynamic),
    )
    white = Spectrum(np.array([0.05, 100.0]), np.ones(2))
    return Vehicle(
        "engine on a frame",
        (engine, frame),
        (),
        groups,
        response_points=(
            ResponsePoint("head", "engine", np.array([0.2, 0.1, 1.1])),
            ResponsePoint("seat", "frame", np.array([0.8, -0.3, 0.6])),
        ),
        forces=(
            Force("random", "engine", np.array([0.1, 0.0, 1.0]), np.array([0.3, 0.1, 1.0]), white),
            Force("shaker", "engine", np.array([0.1, 0.0, 1.0]), np.array([0.3, 0.1, 1.0]), 10.0),
        ),
        base_motions=(BaseMotion("floor", np.array([0.0, 0.2, 1.0]), "displacement", 1e-3),),
    )


def frozen_at(vehicle: Vehicle, rates: MountRates, frequency_hz: float) -> Vehicle:
    """The vehicle with plain springs for mounts, with the rates that these have there."""
    frozen = vehicle.with_rates({"E": rates})
    springs = [s for group in frozen.mount_groups for s in _springs(group, frequency_hz)]
    return replace(vehicle, mount_groups=(), connections=tuple(springs))


def _springs(group: MountGroup, frequency_hz: float) -> Iterator[Spring]:
    """One along each axis of each mount."""
    assert group.dynamic
    there = group.dynamic.complex_rates(np.array([frequency_hz]))[0]
    reference = group.dynamic.complex_rates(np.array([group.dynamic.reference_hz]))[0].real
    k = np.array(group.rates.local()) * there / reference
    for mount in group.mounts:
        for axis in range(3):
            yield Spring(
                f"{mount.name} {axis}",
                "springs",
                mount.bodies,
                mount.points,
                stiffness=k.real[axis] * np.eye(3)[axis],
                loss_factor=k.imag[axis] / k.real[axis],
            )
