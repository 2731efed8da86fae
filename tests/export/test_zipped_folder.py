"""A vehicle as it is tuned, in one file."""

import io
from zipfile import ZipFile

import numpy as np
from mounted_cabin import mounted_cabin

from modeviz.dynamics.assembly import assemble
from modeviz.export.folder import zipped_folder
from modeviz.files import read_vehicle
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.alterations import Alterations, altered
from modeviz.vehicle.placement import Placement


def test_unzipped_it_is_the_vehicle_with_its_rates_placements_and_absorbers(tmp_path):
    roof = Absorber("roof", "cab", (1.0, 0.2, 1.4), 6.0, 12.0, 0.1)
    alterations = Alterations({"A": Placement((0.02, 0.0, 0.0))}, (roof,))
    vehicle = altered(mounted_cabin(), alterations)
    vehicle = vehicle.with_rates(vehicle.all_rates(vehicle.rate_sets["soft"]))
    content = zipped_folder(vehicle)
    assert zipped_folder(vehicle) == content
    with ZipFile(io.BytesIO(content)) as archive:
        archive.extractall(tmp_path)
    read = read_vehicle(tmp_path / "cabin")
    assert read.rates.keys() == vehicle.rates.keys()
    np.testing.assert_allclose(assemble(read).stiffness, assemble(vehicle).stiffness, rtol=1e-12)
