"""A vehicle is known again wherever it lies, and by what of it changed when it did."""

import shutil
from dataclasses import replace

import numpy as np
from folders import one_of_everything
from mounted_cabin import mounted_cabin

from modeviz.files import builtin_vehicle, read_vehicle, write_vehicle
from modeviz.journal.fingerprint import Fingerprint, fingerprint_of


def test_a_folder_that_is_copied_or_written_again_is_the_same_vehicle(tmp_path):
    vehicle = one_of_everything()
    write_vehicle(vehicle, tmp_path / "one")
    shutil.copytree(tmp_path / "one", tmp_path / "copy")
    write_vehicle(read_vehicle(tmp_path / "copy"), tmp_path / "again")
    found = {fingerprint_of(read_vehicle(tmp_path / name)).digest for name in ("one", "copy", "again")}
    assert found == {fingerprint_of(vehicle).digest}


def test_the_order_of_named_rates_does_not_count():
    vehicle = mounted_cabin()
    vehicle = replace(vehicle, rate_sets={"own": vehicle.rates, **vehicle.rate_sets})
    sets = {name: dict(reversed(list(r.items()))) for name, r in vehicle.rate_sets.items()}
    assert max(map(len, sets.values())) > 1
    turned = replace(vehicle, rate_sets=dict(reversed(list(sets.items()))))
    assert fingerprint_of(turned).digest == fingerprint_of(vehicle).digest


def test_the_last_bits_of_numbers_do_not_count():
    vehicle = one_of_everything()
    tyres = tuple(
        replace(each, points=each.points * (1 + 1e-15)) if each in vehicle.tyres else each
        for each in vehicle.connections
    )
    speed = float(np.nextafter(vehicle.speed, 100))
    near = replace(vehicle, connections=tyres, speed=speed)
    assert fingerprint_of(near).digest == fingerprint_of(vehicle).digest


def test_what_changed_is_named():
    vehicle = one_of_everything()
    group = vehicle.mount_groups[0]
    stiffer = replace(group.rates, lateral=group.rates.lateral * 1.000001)
    changed = vehicle.with_rates({group.name: stiffer})
    told = fingerprint_of(changed).changed_since(fingerprint_of(vehicle))
    assert told == (f"mount group {group.name}",)


def test_the_first_of_its_kind_is_told_as_new():
    vehicle = one_of_everything()
    without = replace(vehicle, response_points=())
    told = fingerprint_of(vehicle).changed_since(fingerprint_of(without))
    assert told == tuple(f"new response point {point.name}" for point in vehicle.response_points)


def test_a_fingerprint_survives_as_text():
    found = fingerprint_of(one_of_everything())
    assert Fingerprint.of_text(found.text) == found
    assert Fingerprint.of_text(found.text).digest == found.digest


def test_the_pickup_has_a_fingerprint_that_is_the_same_each_time():
    vehicle = read_vehicle(builtin_vehicle())
    assert fingerprint_of(vehicle) == fingerprint_of(vehicle)
    assert "mount group C2" in fingerprint_of(vehicle).parts
