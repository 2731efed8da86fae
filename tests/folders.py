"""A vehicle that has one of everything, and what tests do with its folder."""

import numpy as np

from modeviz.vehicle.bodies import (
    AddedMass,
    Attachment,
    FlexibleBody,
    Material,
    MeshPart,
    RigidBody,
)
from modeviz.vehicle.connections import GROUND, Bolt, Damper, Mount, Rod, Spring, Tyre
from modeviz.vehicle.load_cases import LoadCase, StaticLoad
from modeviz.vehicle.loads import BaseMotion, Force, ResponsePoint, Road, Spectrum, WheelLoad
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.progressive import ForceCurve
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle

ORIGIN = np.zeros((2, 3))
N_MODES = 11
N_RESIDUALS = 2


def part(name: str, rng: np.random.Generator, opacity: float = 1.0) -> MeshPart:
    """Vertices in no order, two of them in the same place, representable in single precision."""
    vertices = rng.normal(size=(6, 3)).astype(np.float32).astype(float)
    vertices[4] = vertices[1]
    faces = np.array([[5, 0, 3], [1, 2, 4], [4, 5, 1]])
    return MeshPart(name, vertices, faces, Material((3, 127, 250), opacity, 0.31, 0.77))


def flexible_body(name: str = "cab") -> FlexibleBody:
    """Random shapes but for the rigid modes: files don't mind."""
    rng = np.random.default_rng(1)
    omega_n_squared = np.r_[np.zeros(6), np.sort(rng.uniform(1e4, 1e6, N_MODES - 6))]

    def motions(places):
        rigid = rigid_motions(places) / np.sqrt([300.0, 300.0, 300.0, 200.0, 250.0, 280.0])
        elastic = rng.normal(size=(*np.shape(places)[:-1], 6, N_MODES - 6))
        return np.concatenate([rigid, elastic], axis=-1)

    attachments = tuple(
        Attachment(where, position, motions(position))
        for where, position in (("origin", np.zeros(3)), ("floor link", np.array([0.1, 0.2, 0.3])))
    )
    nodes = rng.normal(size=(5, 3))
    mesh = (part("skin", rng), part("door, left", rng, 0.4))
    return FlexibleBody(
        name,
        "cabin",
        "cab",
        omega_n_squared,
        N_RESIDUALS,
        0.03,
        attachments,
        nodes,
        motions(nodes),
        mesh,
    )


def engine() -> RigidBody:
    inertia = np.array([[12.6, -0.3, 1.7], [-0.3, 29.6, 0.0], [1.7, 0.0, 20.3]])
    return RigidBody("Engine & box", "powertrain", "engine", 240.5, np.array([0.1, 0, 0.58]), inertia)


def bump_stop() -> ForceCurve:
    """Harder to one side than to the other."""
    return ForceCurve(
        np.array([-0.01, -0.002, 0.005, 0.02 / 3]), np.array([-5e3, -1e3, 2.5e3, 1e4 / 3])
    )


def mount_group() -> MountGroup:
    rates = MountRates(1094000.0, 670000.0, 131000.0 / 3)
    bounds = MountRates(1e5, 1e5, 1e4), MountRates(2e6, 2e6, 2e6)
    mounts = tuple(
        Mount(f"C1 {side}", "", ("cab", "Engine & box"), ORIGIN) for side in ("left", "right")
    )
    return MountGroup(
        "C1",
        "cab front",
        rates,
        0.15,
        bounds,
        mounts,
        (0.25, 0.8),
        static_ratio=1.45,
        travel={"vertical": (-0.0085, 0.005), "fore-aft": (-0.003, 0.004)},
        curves={"lateral": bump_stop()},
    )


def connections() -> tuple[Spring | Rod | Bolt | Damper | Tyre, ...]:
    """One of each kind, in the file's order, no quantity left out."""
    tilted = np.array([[0.6, 0.8, 0.0], [-0.8, 0.6, 0.0], [0.0, 0.0, 1.0]])
    apart = np.array([[0.0, 0.0, 0.0], [0.0, 0.1, 0.7]])
    ends = ("cab", "Engine & box")
    return (
        Spring(
            "arm",
            "bushings",
            ends,
            apart,
            np.array([1e5, 2e5, 1e5 / 3]),
            axes=tilted,
            elastic_center=0.3,
        ),
        Rod.between("rod", "rods", ends, apart, 1.3e7, 55.5, 0.02),
        Bolt("bolt", "bolts", ends, ORIGIN, np.full(3, 1.7e8), np.full(3, 1e5 / 7), loss_factor=0.01),
        Damper("shock", "shocks", ends, ORIGIN, damping=np.array([0.0, 0.0, 1234.5])),
        Tyre(
            "tyre left",
            "tyres",
            ("Engine & box", GROUND),
            ORIGIN,
            np.array([1e5, 7e4, 2.4908e5]),
            wheel_center=np.array([0.0, -0.8, 0.355]),
            trail=0.035869,
            track="left",
        ),
    )


def road() -> Road:
    rng = np.random.default_rng(2)
    frequency_hz = np.arange(1, 8) / 3
    left, right = rng.uniform(1e-6, 2e-6, (2, 7))
    cross = 0.7 * np.sqrt(left * right) * np.exp(1j * rng.normal(size=7))
    spectrum = np.array([[left, cross], [cross.conj(), right]]).transpose(2, 0, 1)
    return Road("road 1", "rough", 20.0, frequency_hz, spectrum)


def spectrum() -> Spectrum:
    rng = np.random.default_rng(3)
    return Spectrum(np.cumsum(rng.uniform(0.1, 1.0, 6)), rng.uniform(1e-4, 1e-2, 6))


def forward_torque() -> LoadCase:
    """Of the engine, and a push of the cab off its centre of gravity."""
    torque = StaticLoad("Engine & box", torque=np.array([100.0, 1250.0 / 3, 0.0]))
    push = StaticLoad("cab", np.array([0.0, 0.0, -750.5]), position=np.array([0.1, 0.2, 0.25]))
    return LoadCase("forward torque", loads=(torque, push))


def one_of_everything() -> Vehicle:
    return Vehicle(
        'Bänk "42", and\nmore',
        (flexible_body(), engine()),
        connections(),
        (mount_group(),),
        (AddedMass("driver", "cab", np.array([0.01, -0.02, 0.03]), 75.0),),
        (ResponsePoint("seat track left", "cab", np.array([0.0, 0.0, 0.05])),),
        (road(),),
        (
            WheelLoad("unbalance left", "unbalance", "tyre left", 0.0123),
            WheelLoad("radial left", "radial force", "tyre left", 35.6),
        ),
        {"optimised": {"C1": MountRates(1e6 / 3, 131000.0, 0.0, loss_factor=0.1)}},
        88 / 3.6,
        forces=(
            Force("shaker", "cab", np.array([0.01, 0.02, 0.05]), np.array([0.0, 0.6, -0.8]), 12.5),
            Force("wind, gusts", "cab", np.zeros(3), np.array([0.0, 1.0, 0.0]), spectrum()),
        ),
        base_motions=(
            BaseMotion("post", np.array([0.0, 0.0, 1.0]), "displacement", 0.0012, ("tyre left",)),
            BaseMotion("floor", np.array([1.0, 0.0, 0.0]), "acceleration", spectrum(), ("tyre left",)),
        ),
        load_cases=(LoadCase("pothole", np.array([-0.5, 0.0, -3.0])), forward_torque()),
    )
