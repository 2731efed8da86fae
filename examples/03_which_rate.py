"""Which mount rate moves the cab's yaw, and how far can the paper's own equation be trusted?

Derivatives say what every rate does to a mode and to the seat. The classic method, an eigenproblem in
the original vehicle's modes alone, is what the paper searched with; the enriched basis costs hardly
more.
"""

import modeviz as mv
from modeviz.analysis.exact_check import classic_error

study = mv.Study()
sensitivity = study.sensitivity("road 1")
# For ten percent more of each rate: hertz of the cab's yaw, and parts of the lateral RMS at the seat.
yaw_hz = sensitivity.of_mode("cab yaw")
seat = sensitivity.of_rms(study.points[0], "lateral")

study.rates.use("optimised")
classic = classic_error(study.ride("road 1").results)

if __name__ == "__main__":
    for rate in sorted(yaw_hz, key=lambda r: -abs(yaw_hz[r]))[:5]:
        print(f"{rate} +10 %: cab yaw {yaw_hz[rate]:+.3f} Hz, seat lateral {seat[rate]:+.2%}")
    assert classic is not None
    mode = study.modes()[classic.mode]
    print(f"at the optimised rates the classic method is up to {classic.error:.1%} off:")
    print(f"{mode.name} at {classic.frequency_hz:.2f} instead of {mode.frequency_hz:.2f} Hz")
