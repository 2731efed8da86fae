"""Builds the pickup that comes with modeviz: python assets/build_truck.py [FOLDER].

Prints the static stiffness of its bare frame, cab and box. One machine writes the same bytes always.
Another kind of processor rounds mode shapes and vertices otherwise, in their last digits; the tests
compare the shipped folder but for these.
"""

import sys
from pathlib import Path

from pickup.parameters import Parameters
from pickup.stiffness import static_stiffness
from pickup.vehicle import pickup

from modeviz.files import write_vehicle

TRUCK = Path(__file__).parent / "truck"

if __name__ == "__main__":
    parameters = Parameters()
    for name, stiffness in static_stiffness(parameters).items():
        print(f"bare {name}: {stiffness}")
    write_vehicle(pickup(parameters), Path(sys.argv[1]) if len(sys.argv) > 1 else TRUCK)
