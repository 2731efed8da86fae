"""Where are the six rigid modes of an engine of which there is only a spreadsheet, and how pure?

One rigid body on three mounts: mass, centre of gravity, inertia and the mounts' places and rates stand
in the tables of the folder `09_engine`, as a spreadsheet saves them; `modeviz new powertrain FOLDER`
writes such a folder to begin with. Which mode is which, how much of each is in one direction, and what
rates of the same three mounts take the modes apart? And where do the mounts belong if every mode is to
be 97 % pure, which no rates of mounts in these places give, and there are 30 mm of room to move each?
"""

from dataclasses import replace
from pathlib import Path

import modeviz as mv

FOLDER = Path(__file__).parent / "09_engine"
MOUNTS = ("M1", "M2", "M3")
ROOM = dict.fromkeys("xyz", (-0.03, 0.03))

study = mv.Study(FOLDER)
modes = study.modes()
frequency_hz = {mode.name: mode.frequency_hz for mode in modes}
drawn = study.rigid()
found = study.optimise(starts=10)
study.rates.use(found.rates)
decoupled = study.rigid()

asked = replace(study.vehicle.decoupling, purity=0.97)
strict = mv.Study(replace(study.vehicle, decoupling=asked))
rates = mv.Problem("rates", tuple(mv.DesignGroup(name) for name in MOUNTS), goal="decoupling")
places = replace(rates, groups=tuple(mv.DesignGroup(name, offsets=ROOM) for name in MOUNTS))
in_place, moved = strict.optimise(rates, starts=3), strict.optimise(places, starts=3)
placed = mv.Study(moved.vehicle).rigid()

if __name__ == "__main__":
    print(modes)
    for name, hz in frequency_hz.items():
        print(f"{name} at {hz:.4f} Hz")
    print(drawn, found, decoupled, in_place, moved, placed, sep="\n\n")
