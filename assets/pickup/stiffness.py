"""Static stiffness of the bare frame and bodies, the check that is made before anything is coupled."""

from dataclasses import dataclass

import numpy as np

from modeviz.fem.matrices import Matrices, assemble
from modeviz.fem.statics import beaming_stiffness, station, torsional_stiffness
from modeviz.units import factor
from pickup.parameters import Parameters
from pickup.sides import Place
from pickup.vehicle import components

STATIONS: dict[str, tuple[Place, Place, Place]] = {
    "frame": ((0.0, 0.38, 0.50), (1.6, 0.45, 0.44), (2.98, 0.48, 0.64)),
    "cab": ((0.97, 0.62, 0.57), (1.5, 0.60, 0.60), (1.93, 0.62, 0.57)),
    "box": ((2.30, 0.47, 0.70), (3.14, 0.47, 0.74), (4.10, 0.47, 0.70)),
}
"""Where each is loaded and held, right side: the frame at the axles, the bodies at their end mounts,
beaming between them."""


@dataclass(frozen=True)
class StaticStiffness:
    """What engineers compare frames and bodies by."""

    torsion: float
    """N m/rad between the end stations."""
    beaming: float
    """N/m at the middle station on supports at the end ones."""

    def __str__(self) -> str:
        per_degree = self.torsion / factor("N m/deg", "rotational_stiffness")
        per_mm = self.beaming / factor("N/mm", "stiffness")
        return f"torsion {per_degree:.0f} N m/deg, beaming {per_mm:.0f} N/mm"


def static_stiffness(p: Parameters) -> dict[str, StaticStiffness]:
    """Of the bare frame, cab and box by name."""
    bodies = {part.name: part for part in components(p)}
    return {
        name: _between(
            assemble(bodies[name].structure.mesh).scaled(
                bodies[name].stiffness_factor, bodies[name].mass_factor
            ),
            places,
        )
        for name, places in STATIONS.items()
    }


def _between(matrices: Matrices, places: tuple[Place, Place, Place]) -> StaticStiffness:
    front, middle, rear = (station(matrices.nodes, np.array(place)) for place in places)
    return StaticStiffness(
        torsional_stiffness(matrices, front, rear),
        beaming_stiffness(matrices, front, middle, rear),
    )
