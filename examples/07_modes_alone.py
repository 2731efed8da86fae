"""What do residual vectors add to a truck of truncated components?

A. E. Duncan keeps 60, 40, 40 and 30 modes of the front end, cab, box and frame, and softens the bolts
between front end and cab by what the modes left out would give there. The built-in pickup keeps as
many, with a residual vector for every direction in which something pulls. How far off is the paper's
way? Below 20 Hz there are as many modes either way, so they are compared in their order.
"""

import numpy as np

import modeviz as mv
from modeviz.dynamics.truncation import modes_only

vehicle = mv.Study().vehicle
with_residuals = mv.Study(vehicle).modes()
modes_alone = mv.Study(modes_only(vehicle)).modes()
low = (with_residuals.frequency_hz > 0.1) & (with_residuals.frequency_hz < 20)
hz = with_residuals.frequency_hz[low]
too_high = modes_alone.frequency_hz[: len(low)][low] / hz - 1

if __name__ == "__main__":
    for mode, off in zip(np.array(list(with_residuals))[low], too_high, strict=True):
        print(f"{mode.frequency_hz:6.2f} Hz  {mode.name:28} modes alone {off:+7.2%}")
