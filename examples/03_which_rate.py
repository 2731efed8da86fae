"""Which mount rate moves the cab's yaw, and how far can the paper's own equation be trusted?

Derivatives say what every rate does to a mode and to the seat. The classic method, an eigenproblem in
the original vehicle's modes alone, is what the paper searched with; the enriched basis costs hardly
more.
"""

import numpy as np

import modeviz as mv

vehicle = mv.read_vehicle(mv.builtin_vehicle())
prepared = mv.prepare(vehicle)
conditions = mv.Conditions("road 1", vehicle.speed)
variables = mv.rate_variables(vehicle)
own = np.array([getattr(vehicle.rates[v.group], v.direction) for v in variables])

original = mv.solve(prepared, {}, conditions)
yaw = original.mode_index("cab yaw")
# For ten per cent more of each rate: hertz of the cab's yaw, and g of lateral RMS at the seat.
yaw_hz = 0.1 * own * mv.frequency_sensitivity(original)[yaw]
seat_g = 0.1 * own * mv.ride_sensitivity(prepared, {}, conditions).rms[0, 1]

optimised = mv.solve(prepared, vehicle.rate_sets["optimised"], conditions)
classic = mv.classic_error(optimised)

if __name__ == "__main__":
    for i in np.argsort(-np.abs(yaw_hz))[:5]:
        rate = f"{variables[i].group} {variables[i].direction.replace('_', '-')}"
        print(f"{rate} +10 %: cab yaw {yaw_hz[i]:+.3f} Hz, seat lateral {seat_g[i]:+.5f} g")
    assert classic is not None
    worst, found = optimised.names[classic.mode].name, optimised.modes.frequency_hz[classic.mode]
    print(f"at the optimised rates the classic method is up to {classic.error:.1%} off:")
    print(f"{worst} at {classic.frequency_hz:.2f} instead of {found:.2f} Hz")
