"""What does a truck's cab gain from springs half as stiff, and what does it cost?

A cab of 980 kg on four spring-dampers, as `modeviz new cab FOLDER` writes it: two tables, and the
shaking of the frame below. With springs half as stiff it bounces √2 slower, its struts pass less on and
the seat is shaken less; it sags twice as far.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import modeviz as mv

SOFTER = 0.5

with TemporaryDirectory() as folder:
    study = mv.Study(mv.new_vehicle("cab", Path(folder) / "cab"))


def looked_at() -> dict[str, float]:
    """What counts with the present rates: Hz, m, N and g."""
    forces = study.forces("shaking frame")
    struts = [name for name in forces.connections if name.startswith(("front", "rear"))]
    return {
        "bounce, Hz": study.modes()["cab bounce"].frequency_hz,
        "sag, m": -study.static().sag("cab")[2],
        "force of a strut, N RMS": max(forces.rms(name, "z") for name in struts),
        "seat, vertical, g RMS": study.ride().rms("driver's seat", "vertical"),
    }


drawn = looked_at()
for group in ("F", "R"):
    study.rates[f"{group}.vertical"] = SOFTER * study.vehicle.rates[group].vertical
soft = looked_at()

if __name__ == "__main__":
    for name, value in drawn.items():
        print(f"{name:26}{value:9.3f} drawn {soft[name]:9.3f} soft")
    print(study.rigid())
