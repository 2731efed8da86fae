"""Where are the six rigid modes of an engine of which there is only a spreadsheet, and how pure?

One rigid body on three mounts: mass, centre of gravity, inertia and the mounts' places and rates stand
in the tables of the folder `09_engine`, as a spreadsheet saves them; `modeviz new powertrain FOLDER`
writes such a folder to begin with. Which mode is which, how much of each is in one direction, and what
rates of the same three mounts take the modes apart?
"""

from pathlib import Path

import modeviz as mv

FOLDER = Path(__file__).parent / "09_engine"

study = mv.Study(FOLDER)
modes = study.modes()
frequency_hz = {mode.name: mode.frequency_hz for mode in modes}
drawn = study.rigid()
found = study.optimise(starts=10)
study.rates.use(found.rates)
decoupled = study.rigid()

if __name__ == "__main__":
    print(modes)
    for name, hz in frequency_hz.items():
        print(f"{name} at {hz:.4f} Hz")
    print(drawn, found, decoupled, sep="\n\n")
