"""A machine with every kind of connection: rubber, dampers, rigid joints, a tyre and a rod."""

from dataclasses import replace

import numpy as np
from oracles import Beam

from modeviz.vehicle.bodies import AddedMass, RigidBody
from modeviz.vehicle.connections import GROUND, MOTIONS, Bolt, Damper, Mount, Rod, Spring, Tyre
from modeviz.vehicle.loads import BaseMotion, Force, ResponsePoint, Road, Spectrum, WheelLoad
from modeviz.vehicle.mode_damping import ModeDamping
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

FLAT = Spectrum(np.array([0.01, 100.0]), np.array([2.0, 2.0]))
TURNED = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]])
SLANTED = np.array([0.3, -0.5, 0.8])


def mounted_machine() -> Vehicle:
    """An engine on two mounts of a beam that carries a tank and stands on tyres and on the ground."""
    engine = RigidBody(
        "engine", "powertrain", "engine", 80.0, np.array([0.5, 0.05, 0.4]),
        np.array([[3.0, 0.2, -0.1], [0.2, 4.0, 0.3], [-0.1, 0.3, 5.0]]),
    )  # fmt: skip
    frame = replace(Beam(8, 2.0).body("frame"), role="frame", loss_factor=0.01)
    hub = RigidBody("hub", "unsprung", "hub", 30.0, np.array([1.0, 0.0, -0.2]), np.eye(3))
    table = RigidBody("table", "linkage", "table", 200.0, np.array([0.0, 0.0, -0.5]), 9 * np.eye(3))
    softest, stiffest = MountRates(1e3, 1e3, 1e3), MountRates(1e7, 1e7, 1e7)
    front = Mount(
        "front", "E", ("engine", "frame"), np.array([[0.25, 0.0, 0.1], [0.25, 0.0, 0.0]]), axes=TURNED,
        damping=np.array([100.0, 0.0, 300.0]), rotational_stiffness=np.array([2e3, 0.0, 1e3]),
    )  # fmt: skip
    rear = Mount("rear", "E", ("engine", "frame"), np.array([[0.75, 0.0, 0.1], [0.75, 0.0, 0.0]]))
    foot = Mount("foot", "F", ("frame", GROUND), np.zeros((2, 3)), damping=np.full(3, 50.0),
                 rotational_damping=np.full(3, 5.0))  # fmt: skip
    groups = (
        MountGroup("E", "engine", MountRates(3e5, 1e5, 2e5), 0.1, (softest, stiffest), (front, rear)),
        MountGroup("F", "foot", MountRates(4e5, 2e5, 3e5), 0.2, (softest, stiffest), (foot,)),
    )
    connections = (
        Spring(
            "spring", "springs", ("frame", "hub"), np.array([[1.0, 0.0, 0.0], [1.0, 0.0, -0.2]]),
            stiffness=np.array([2e5, 2e5, 5e4]), rotational_stiffness=np.full(3, 1e3), loss_factor=0.02,
        ),
        Damper("damper", "dampers", ("frame", "hub"), np.array([[1.0, 0.0, 0.0], [1.0, 0.0, -0.2]]),
               damping=np.array([0.0, 0.0, 800.0])),
        Tyre("tyre", "tyres", ("hub", GROUND), np.array([[1.0, 0.0, -0.5], [1.0, 0.0, -0.5]]),
             stiffness=np.array([1e5, 1e5, 2e5]), damping=np.full(3, 400.0),
             wheel_center=np.array([1.0, 0.0, -0.2]), track="left"),
        Rod.between("rod", "rods", ("engine", "table"), np.array([[0.5, 0.3, 0.4], [0.0, 0.3, -0.4]]),
                    rigid=True),
        Spring("stand", "stands", ("frame", "table"), np.array([[1.75, 0.0, 0.0], [1.75, 0.0, 0.0]]),
               stiffness=np.full(3, 1e5)),
        Bolt("bolt", "bolts", ("table", GROUND), np.zeros((2, 3)), rigid=MOTIONS),
    )  # fmt: skip
    f = np.linspace(0.05, 60, 200)
    spectrum = np.zeros((200, 2, 2), complex)
    spectrum[:, 0, 0], spectrum[:, 1, 1] = 1e-5 / f**2, 2e-5 / f**2
    spectrum[:, 0, 1] = 5e-6j / f**2
    spectrum[:, 1, 0] = spectrum[:, 0, 1].conj()
    return Vehicle(
        "machine", (engine, frame, hub, table), connections, groups,
        added_masses=(AddedMass("tank", "frame", np.array([1.5, 0.1, 0.0]), 12.0),),
        response_points=(
            ResponsePoint("sensor", "frame", np.array([0.5, 0.0, 0.05])),
            ResponsePoint("head", "engine", np.array([0.5, 0.0, 0.8])),
        ),
        roads=(Road("road", "Road", 20.0, f, spectrum),),
        wheel_loads=(WheelLoad("unbalance", "unbalance", "tyre", 0.01),),
        forces=(
            Force("firing", "engine", np.array([0.5, 0.1, 0.5]), SLANTED, 10.0),
            Force("noise", "frame", np.array([1.25, 0.0, 0.0]), SLANTED, FLAT),
        ),
        base_motions=(
            BaseMotion("floor", SLANTED, "acceleration", 1.0),
            BaseMotion("random floor", SLANTED, "acceleration", FLAT),
        ),
        mode_damping=(ModeDamping(0.2, 8),),
    )  # fmt: skip
