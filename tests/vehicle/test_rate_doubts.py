"""Doubts about rates that their bounds leave out."""

from dataclasses import replace

import pytest
from mounted_cabin import mounted_cabin

from modeviz.cli import main
from modeviz.files import read_vehicle
from modeviz.files.new_vehicle import new_vehicle
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.rate_doubts import rate_doubts


def group_with(**changes):
    """The cabin whose first group has other rates or bounds."""
    vehicle = mounted_cabin()
    group, *others = vehicle.mount_groups
    return replace(vehicle, mount_groups=(replace(group, **changes), *others))


@pytest.mark.parametrize("kind", ["cab", "cab-on-frame", "machine", "powertrain"])
def test_no_new_vehicle_is_doubted(tmp_path, kind):
    assert not list(rate_doubts(read_vehicle(new_vehicle(kind, tmp_path / "new"))))


def test_a_rate_on_its_bound_is_inside():
    group = mounted_cabin().mount_group("A")
    stiffest = replace(group.bounds[1], vertical=group.rates.vertical * (1 - 1e-12))
    assert not list(rate_doubts(group_with(bounds=(group.bounds[0], stiffest))))


def test_a_rate_outside_of_its_bounds_is_told_with_them():
    bounds = MountRates(1e5, 1e5, 1e5), MountRates(5e5, 2e6, 2e6)
    (doubt,) = rate_doubts(group_with(rates=MountRates(8e5, 3e5, 3e5), bounds=bounds))
    assert doubt == "mount group 'A': vertical is 800 N/mm, outside of its bounds, 100 to 500 N/mm"


def test_bounds_of_damping_without_damping_are_told():
    group = mounted_cabin().mount_group("A")
    bounds = group.bounds[0], replace(group.bounds[1], damping_vertical=900.0)
    vehicle = group_with(bounds=bounds)
    (doubt,) = rate_doubts(vehicle)
    assert doubt.startswith(
        "mount group 'A': damping-vertical is zero and has bounds, 0 to 900 N s/m: a search"
    )


def test_the_check_of_a_folder_tells_them(tmp_path, capsys):
    folder = new_vehicle("cab", tmp_path / "cab")
    table = folder / "mounts.csv"
    table.write_text(table.read_text("utf-8").replace(",1600,", ",160,"), "utf-8")
    main(["check", str(folder)])
    found = capsys.readouterr().out
    assert "mount group 'F': damping-vertical is 160 N s/m, outside of its bounds" in found
