"""What does a cab gain from other dampers, or from springs half as stiff, and what does it cost?

A cab of 980 kg on four spring-dampers, as `modeviz new cab FOLDER` writes it: two tables, and the
shaking of the frame below. Dampers are tuned like springs: weak ones let it bounce on, strong ones pass
on what shakes faster, and under shaking alike at all frequencies half of critical damping is best. With
springs half as stiff it bounces √2 slower, its struts pass less on and the seat is shaken less; it sags
twice as far.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import modeviz as mv

SOFTER = 0.5
DAMPERS = (0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8)
"""Of what is drawn: those that are tried."""

with TemporaryDirectory() as folder:
    study = mv.Study(mv.new_vehicle("cab", Path(folder) / "cab"))


def scale(field: str, factor: float) -> None:
    """Make a rate of all struts so many times what is drawn."""
    for group in ("F", "R"):
        study.rates[f"{group}.{field}"] = factor * getattr(study.vehicle.rates[group], field)


def seat() -> float:
    """How the driver's seat is shaken with the present rates, g."""
    return study.ride().rms("driver's seat", "vertical")


def looked_at() -> dict[str, float]:
    """What counts with the present rates: Hz, m, N and g."""
    forces = study.forces("shaking frame")
    struts = [name for name in forces.connections if name.startswith(("front", "rear"))]
    bounce = study.modes()["cab bounce"]
    return {
        "bounce, Hz": bounce.frequency_hz,
        "bounce, damping ratio": bounce.damping_ratio,
        "sag, m": -study.static().sag("cab")[2],
        "force of a strut, N RMS": max(forces.rms(name, "z") for name in struts),
        "seat, vertical, g RMS": seat(),
    }


def with_dampers(factor: float) -> float:
    """How the seat is shaken with other dampers, g."""
    scale("damping_vertical", factor)
    return seat()


drawn = looked_at()
shaken = {factor: with_dampers(factor) for factor in DAMPERS}
best = min(shaken, key=shaken.__getitem__)
scale("damping_vertical", best)
damped = looked_at()

study.rates.reset()
scale("vertical", SOFTER)
soft = looked_at()

if __name__ == "__main__":
    print(f"{'':26}{'drawn':>9}{f'dampers × {best}':>15}{'soft':>9}")
    for name in drawn:
        print(f"{name:26}{drawn[name]:9.3f}{damped[name]:15.3f}{soft[name]:9.3f}")
    print(study.rigid())
