"""Builds the pickup that comes with modeviz: python assets/build_truck.py [FOLDER]."""

import sys
from pathlib import Path

from pickup.parameters import Parameters
from pickup.vehicle import pickup

from modeviz.vehicle.files import write_vehicle

TRUCK = Path(__file__).parent / "truck"

if __name__ == "__main__":
    write_vehicle(pickup(Parameters()), Path(sys.argv[1]) if len(sys.argv) > 1 else TRUCK)
