"""Bodies as binary glTF, in metres and upright as glTF has it: y up, the front towards z."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from modeviz.errors import VehicleError, listed
from modeviz.files.meshes import glb_file
from modeviz.vehicle.bodies import Body

UPRIGHT = np.array([[0.0, -1, 0, 0], [0, 0, 1, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
"""(4, 4): from x rearward, y right, z up (glTF 2.0, section 3.4)."""


def bodies_glb(bodies: Sequence[Body]) -> bytes:
    """Return the meshes of bodies as a binary glTF file, a node for each part of each body.

    Raises:
        VehicleError: none of them has a mesh.
    """
    parts = [replace(p, name=f"{b.name}: {p.name}") for b in bodies for p in b.mesh]
    if not parts:
        names = listed(body.name for body in bodies)
        raise VehicleError(f"no mesh to write: {names} without one; give its body a mesh")
    return glb_file(tuple(parts), UPRIGHT)
