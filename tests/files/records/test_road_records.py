"""Roads in a vehicle's folder: of ISO 8608, and tables as they come."""

import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle

UNITS = {"length": "mm", "mass": "kg", "inertia": "kg m²", "stiffness": "N/mm", "speed": "km/h"}
WHEEL = """
[[rigid_body]]
name = "{side}"
mass = 10.0
center_of_gravity = [0.0, {y}, 300.0]
inertia = [1.0, 1.0, 1.0]
[[tyre]]
name = "{side} tyre"
bodies = ["{side}", "ground"]
at = [0.0, {y}, 0.0]
wheel_center = [0.0, {y}, 300.0]
stiffness = [100.0, 100.0, 200.0]
"""
AXLE = WHEEL.format(side="left", y=-800.0) + WHEEL.format(side="right", y=700.0)


@pytest.fixture
def read(tmp_path):
    """An axle 1.5 m wide over a road with these keys, and a table beside it."""

    def read(keys, table="", **units):
        declared = "\n".join(f'{key} = "{unit}"' for key, unit in {**UNITS, **units}.items())
        text = f'name = "axle"\n[units]\n{declared}\n{AXLE}\n[[road]]\nname = "road"\n{keys}\n'
        (tmp_path / "vehicle.toml").write_text(text, encoding="utf-8")
        (tmp_path / "road.csv").write_text(table, encoding="utf-8")
        return read_vehicle(tmp_path)

    return read


def test_a_class_is_a_road_whose_tracks_are_as_far_apart_as_the_tyres(read):
    roughness = read('iso_8608 = "B"').roads[0].roughness
    assert roughness.level == pytest.approx(64e-6)
    assert (roughness.waviness, roughness.track_width) == (2.0, pytest.approx(1.5))


def test_a_level_between_has_its_unit(read):
    keys = "roughness = 100.0\nwaviness = 2.4\ntrack_width = 1400.0"
    roughness = read(keys, roughness="cm³").roads[0].roughness
    assert roughness.level == pytest.approx(100e-6)
    assert (roughness.waviness, roughness.track_width) == (2.4, pytest.approx(1.4))


@pytest.mark.parametrize("keys", ['iso_8608 = "B"', "roughness = 100.3\nwaviness = 2.4"])
def test_a_road_of_iso_8608_is_written_as_one(read, keys, tmp_path):
    vehicle = read(keys, roughness="cm³")
    write_vehicle(vehicle, tmp_path / "again")
    assert not list((tmp_path / "again" / "roads").iterdir())
    (road,), (again,) = vehicle.roads, read_vehicle(tmp_path / "again").roads
    assert again.roughness == road.roughness
    assert np.array_equal(again.spectrum, road.spectrum)


def test_a_table_without_cross_spectrum_takes_its_track_width_or_the_vehicles(read):
    table = "n (cycles/m),track (m³)\n0.05,1e-4\n5,1e-8\n"
    wide, narrow = (read(f'file = "road.csv"\n{keys}', table) for keys in ("", "track_width = 1200.0"))
    assert "1.5 m apart, of waviness 2:" in f"{wide.notes[0]}:"
    assert "1.2 m apart" in narrow.notes[0]
    S_wide, S_narrow = (vehicle.roads[0].spectrum[0, 0, 1].real for vehicle in (wide, narrow))
    assert S_wide < S_narrow < 1e-4


def test_a_track_width_beside_a_cross_spectrum_is_refused(read):
    table = "n (cycles/m),left,right,coherence\n0.05,1e5,1e5,1\n5,10,10,0\n"
    with pytest.raises(VehicleError, match="track_width: does nothing beside a cross spectrum"):
        read('file = "road.csv"\ntrack_width = 1200.0', table)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ("", "found none, expected one of file, iso_8608, roughness"),
        ('iso_8608 = "B"\nroughness = 100.0', "found iso_8608 and roughness, expected one of"),
        ('iso_8608 = "K"', "'K'"),
        ("roughness = -1.0", "above zero"),
        ('iso_8608 = "B"\nwaviness = 0.5', "waviness: found 0.5, expected 1.2 to 4"),
        ('iso_8608 = "B"\nspeed = 72.0', "speed: does nothing beside iso_8608, leave it out"),
        ('file = "road.csv"\nspeed = 72.0\nwaviness = 2.0', "waviness: does nothing beside file"),
    ],
)
def test_what_is_no_road_is_refused(read, keys, words):
    with pytest.raises(VehicleError, match=words):
        read(keys, roughness="cm³")
