"""A mount table that is written puts the same mounts into a folder that has none."""

import csv
from dataclasses import replace
from io import StringIO

import numpy as np
import pytest
from cab_on_struts import cab_on_struts
from many_mounts import many_mounts
from turned_vehicles import turned_folder

from modeviz.cli import main
from modeviz.export.mount_table import mount_table
from modeviz.files import read_vehicle
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

AXES = [("rearward", "right", "up"), ("forward", "left", "up"), ("up", "forward", "left")]


def bare(vehicle: Vehicle) -> Vehicle:
    return replace(vehicle, mount_groups=(), rate_sets={})


def limited(vehicle: Vehicle) -> Vehicle:
    """With a travel, a static ratio and limits of ratios of the first group."""
    first, *others = vehicle.mount_groups
    travel = {"vertical": (-0.0125, 0.0625), "lateral": (-0.25, 0.0)}
    first = replace(first, static_ratio=1.625, ratio_limits=(0.25, 1.5), travel=travel)
    return replace(vehicle, mount_groups=(first, *others))


@pytest.mark.parametrize("words", AXES)
def test_mounts_are_read_again_as_they_were_in_any_axes(words, tmp_path):
    before = read_vehicle(turned_folder(tmp_path / "all", many_mounts(), words))
    tuned = limited(before).with_rates({"Z": MountRates(1e6 / 3, 1e5 / 3, 1e4 / 7, 0.25)})
    (tmp_path / "mounts.csv").write_bytes(mount_table(tuned))
    folder = turned_folder(tmp_path / "bare", bare(many_mounts()), words)
    assert main(["import", str(tmp_path / "mounts.csv"), "--output", str(folder)]) == 0
    after = read_vehicle(folder)
    assert [mount.name for mount in after.mounts] == [mount.name for mount in tuned.mounts]
    for found, expected in zip(after.mounts, tuned.mounts, strict=True):
        assert (found.group, found.bodies) == (expected.group, expected.bodies)
        for name in ("points", "stiffness", "rotational_stiffness", "damping", "axes", "loss_factor",
                     "elastic_center"):  # fmt: skip
            np.testing.assert_allclose(
                getattr(found, name), getattr(expected, name), rtol=1e-14, atol=1e-15
            )
    for found, expected in zip(after.mount_groups, tuned.mount_groups, strict=True):
        assert (found.static_ratio, found.ratio_limits) == (
            expected.static_ratio,
            expected.ratio_limits,
        )
        assert found.travel == expected.travel
        for one, other in zip(found.bounds, expected.bounds, strict=True):
            np.testing.assert_allclose(one.as_tuple(), other.as_tuple(), rtol=1e-14)


def test_every_number_stands_below_its_unit():
    """By hand: the first mount of the cabin's group A, 0.6 m behind the axle, 800 N/mm vertically."""
    first = next(csv.DictReader(StringIO(mount_table(many_mounts()).decode())))
    assert (first["name"], first["group"]) == ("A -0.5", "A")
    assert (first["body_1"], first["body_2"]) == ("cab", "chassis")
    assert [first[f"{axis} [m]"] for axis in "xyz"] == ["0.6", "-0.5", "0.7"]
    assert [first[f"k_{axis} [N/mm]"] for axis in "xyz"] == ["400.0", "300.0", "800.0"]
    assert (first["softest_z [N/mm]"], first["stiffest_z [N/mm]"]) == ("10.0", "10000.0")
    assert first["loss_factor"] == "0.15"


def test_bounds_of_rates_about_axes_and_of_dampers_are_read_again_in_any_axes(tmp_path):
    """Also of dampers alone, which without bounds are not tuned."""
    cab = replace(cab_on_struts(tmp_path / "cab"), base_motions=())
    for i, words in enumerate(AXES):
        before = read_vehicle(turned_folder(tmp_path / f"all {i}", cab, words))
        (tmp_path / "again.csv").write_bytes(mount_table(before))
        folder = turned_folder(tmp_path / f"bare {i}", bare(cab), words)
        assert main(["import", str(tmp_path / "again.csv"), "--output", str(folder)]) == 0
        after = read_vehicle(folder)
        for one, other in zip(before.mount_groups, after.mount_groups, strict=True):
            assert other.fields == one.fields
            for own, its in zip((one.rates, *one.bounds), (other.rates, *other.bounds), strict=True):
                found = [getattr(its, field) for field in one.fields]
                assert found == pytest.approx([getattr(own, field) for field in one.fields], rel=1e-9)
            for a, b in zip(one.mounts, other.mounts, strict=True):
                assert b.damping == pytest.approx(a.damping, rel=1e-9)
                assert b.rotational_stiffness == pytest.approx(a.rotational_stiffness, rel=1e-9)
