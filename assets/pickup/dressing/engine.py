"""The powertrain's look: a V engine, its bell housing and gearbox."""

import numpy as np

from pickup.connections import FRONT_JOINT
from pickup.materials import Piece, both_sides
from pickup.parameters import Parameters
from pickup.solids import Surface, block, cylinder, line, revolved, rotation, shifted, tube

REAR_OF_BLOCK = 0.48
BANK_ANGLE = 42.0
"""Degrees from vertical."""


def pieces(p: Parameters) -> list[Piece]:
    """The whole powertrain."""
    return [
        *_block(),
        *both_sides([*_bank(), *_mount_arm(p)]),
        *_air_cleaner(),
        *_front_drive(),
        *_gearbox(p),
    ]


def _block() -> list[Piece]:
    return [
        Piece("castings", block((0.20, 0, 0.64), (0.54, 0.32, 0.24))),
        Piece("dark", block((0.20, 0, 0.46), (0.46, 0.24, 0.15), top=1.25)),
        Piece("castings", block((0.20, 0, 0.83), (0.40, 0.20, 0.10), top=0.8)),
    ]


def _bank() -> list[Piece]:
    """One row of cylinders with head, valve cover and exhaust manifold."""
    tilt = rotation("x", -BANK_ANGLE)

    def on_bank(surface: Surface) -> Piece:
        return Piece("castings", surface.turned(tilt).moved((0.20, 0.10, 0.70)))

    cover = block((0, 0, 0.24), (0.48, 0.13, 0.07), top=0.88).turned(tilt).moved((0.20, 0.10, 0.70))
    manifold = line((0.02, 0.33, 0.74), (0.42, 0.33, 0.70), 3)
    down = [(0.42, 0.33, 0.70), (0.52, 0.30, 0.58), (0.56, 0.25, 0.43)]
    ports = [tube([(x, 0.27, 0.76), (x, 0.33, 0.73)], 0.022, n=8) for x in np.linspace(0.03, 0.37, 4)]
    return [
        on_bank(block((0, 0, 0.04), (0.50, 0.20, 0.20))),
        on_bank(block((0, 0, 0.17), (0.51, 0.18, 0.09))),
        Piece("dark", cover),
        *(Piece("steel", port) for port in ports),
        Piece("steel", tube(manifold, 0.032, n=10)),
        Piece("steel", tube(down, 0.028, n=10, up=(0, 1, 0))),
    ]


def _mount_arm(p: Parameters) -> list[Piece]:
    seat = p.engine_mount
    return [
        Piece("steel", block(shifted(seat, y=-0.04, z=0.035), (0.11, 0.14, 0.03))),
        Piece("steel", block(shifted(seat, y=-0.06), (0.09, 0.03, 0.12))),
    ]


def _air_cleaner() -> list[Piece]:
    housing = [
        (0, 0),
        (0.17, 0),
        (0.18, 0.012),
        (0.18, 0.055),
        (0.17, 0.065),
        (0.03, 0.072),
        (0, 0.072),
    ]
    center = (0.18, 0, 0.955)
    snorkel = line((0.05, 0.10, 0.985), (-0.22, 0.24, 0.985), 3)
    return [
        Piece("castings", cylinder(0.06, 0.10, "z", (0.18, 0, 0.92), 16)),
        Piece("dark", revolved(housing, "z", center, 24)),
        Piece("dark", tube(snorkel, 0.032, n=10)),
        Piece("chrome", cylinder(0.014, 0.03, "z", (0.18, 0, 1.035), 8)),
    ]


def _front_drive() -> list[Piece]:
    """Pulleys and fan."""
    groove = [(0, -0.025), (0.085, -0.025), (0.075, 0.0), (0.085, 0.025), (0, 0.025)]
    blades = []
    for k in range(6):
        blade = block((0, 0.10, 0), (0.03, 0.14, 0.075)).turned(rotation("y", 35))
        blades.append(Piece("dark", blade.turned(rotation("x", 60 * k)).moved((-0.20, 0, 0.68))))
    return [
        Piece("dark", revolved(groove, "x", (-0.10, 0, 0.52), 18)),
        Piece("dark", revolved(groove, "x", (-0.10, 0, 0.68), 18)),
        Piece("castings", cylinder(0.065, 0.15, "x", (-0.05, 0.22, 0.76), 18)),
        Piece("steel", cylinder(0.045, 0.06, "x", (-0.19, 0, 0.68), 16)),
        *blades,
    ]


def _gearbox(p: Parameters) -> list[Piece]:
    x, _, z = FRONT_JOINT
    bell = [(0, 0), (0.19, 0), (0.185, 0.03), (0.12, 0.22), (0, 0.22)]
    return [
        Piece("castings", revolved(bell, "x", (REAR_OF_BLOCK, 0, 0.60), 24)),
        Piece("castings", block((0.84, 0, 0.545), (0.34, 0.23, 0.22), rear=0.85)),
        Piece("dark", block((0.84, 0, 0.425), (0.28, 0.20, 0.04), top=1.08)),
        Piece("castings", tube([(1.02, 0, 0.51), (1.10, 0, 0.50), (x - 0.06, 0, z)], 0.062, n=16)),
        Piece("steel", block(shifted(p.transmission_mount, z=-0.005), (0.10, 0.14, 0.03))),
    ]
