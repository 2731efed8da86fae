"""Two masses on a spring, floating freely.

At what frequency do they swing against each other, and where does the heavier one carry the energy?
A cab on a stiff mount and a frame under it are such a pair: neither alone has this frequency, and
neither mass alone decides it.
"""

import numpy as np

import modeviz as mv

FRAME_MASS, CAB_MASS, STIFFNESS = 330.0, 420.0, 2.2e6

frame = mv.RigidBody("frame", "frame", "frame", FRAME_MASS, np.array([0.0, 0.0, 0.5]), 50 * np.eye(3))
cab = mv.RigidBody("cab", "cabin", "cab", CAB_MASS, np.array([0.0, 0.0, 0.9]), 80 * np.eye(3))
mount = mv.Spring(
    "mount",
    "mounts",
    ("cab", "frame"),
    points=np.array([[0.0, 0.0, 0.6], [0.0, 0.0, 0.6]]),
    stiffness=np.array([0.0, 0.0, STIFFNESS]),
)

modes = mv.Study(mv.Vehicle("two masses", (frame, cab), (mount,))).modes()
swinging = modes[-1]
cab_mass_share = CAB_MASS / (CAB_MASS + FRAME_MASS)

if __name__ == "__main__":
    print(f"{np.sum(modes.frequency_hz < 1e-3)} of {len(modes)} modes move freely")
    print(f"the masses swing against each other at {swinging.frequency_hz:.2f} Hz")
    share = swinging.kinetic_energy["cab"]
    print(f"the cab, {cab_mass_share:.0%} of the mass, has {share:.0%} of the energy")
