"""Why does the driver sway at 12 Hz, and what do other mounts change?

On the built-in pickup the cab yaws on its mounts close to where the rear axle tramps, so the road
shakes it from side to side. Table 4 of A. E. Duncan's paper has mount rates that move the cab's
yaw out of the way. What happens to the lateral acceleration at the driver's seat?
"""

import modeviz as mv

BAND = (11.0, 17.0)  # Hz, where the paper sees the greatest change

study = mv.Study()
seat = study.points[0]
cab_yaw_hz, rides = {}, {}
for name in ("original", "optimised"):
    study.rates.use(name)
    cab_yaw_hz[name] = study.modes()["cab yaw"].frequency_hz
    rides[name] = study.ride("road 1")

lateral_g = {name: ride.rms(seat, "lateral", BAND) for name, ride in rides.items()}
fall = 1 - lateral_g["optimised"] / lateral_g["original"]

if __name__ == "__main__":
    for name, ride in rides.items():
        peak = max(ride.peaks(seat, "lateral", count=2), key=lambda p: p.level)
        print(f"{name}: cab yaw at {cab_yaw_hz[name]:.2f} Hz, {lateral_g[name]:.4f} g lateral")
        names = " and ".join(part.name for part in peak.parts)
        print(f"  highest peak at {peak.frequency_hz:.1f} Hz, mostly {names}")
        print(f"  rating {ride.rating.mean_personal_rating:.1f}")
    print(f"from {BAND[0]:g} to {BAND[1]:g} Hz the lateral acceleration falls by {fall:.0%}")
