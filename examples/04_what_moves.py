"""What does the truck do at 12 Hz, and which of the cab's own modes take part?

The seat's lateral spectrum has its highest peak there. Three motions help to understand it: how the
whole truck moves on the road at that frequency, as seen from the seat; the damped mode that makes most
of the peak, which is only a part of that; and the cab's own free-free modes, of which the mode is made.
"""

import numpy as np

import modeviz as mv
from modeviz.dynamics.components import component_shares

study = mv.Study()
ride, modes, seat = study.ride("road 1"), study.modes(), study.points[0]
system = ride.results.system

peak = max(ride.peaks(seat, "lateral"), key=lambda p: p.level)
on_road = ride.shape(peak.frequency_hz, seat, "lateral")
mode = modes[peak.parts[0].name]
damped = modes.damped(mode.name)


def likeness(a: np.ndarray, b: np.ndarray) -> float:
    """How much two motions are alike, weighted with mass, 0 to 1."""
    M = system.mass
    product = abs(np.vdot(a, M @ b)) ** 2
    return float(product / np.real(np.vdot(a, M @ a) * np.vdot(b, M @ b)))


shares = component_shares(system, damped.shape, "cab")

if __name__ == "__main__":
    print(f"at {peak.frequency_hz:.1f} Hz mostly {mode.name}")
    print(f"  damped: {damped.damped_frequency_hz:.2f} Hz, {damped.damping_ratio:.1%} of critical")
    print(f"  {likeness(on_road, damped.shape):.0%} of the motion on the road is like it")
    for share in shares[:4]:
        print(f"  {share.share:.1%} of its kinetic energy: cab {share.name}")
