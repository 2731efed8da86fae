"""Force-deflection curves in files beside vehicle.toml: units, scales, and what is wrong where."""

from pathlib import Path

import numpy as np
import pytest
from progressive_block import CURVE, progressive_block

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.vehicle import Vehicle


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The block's folder, its curve in curve.csv and no vertical rate."""
    write_vehicle(progressive_block(), tmp_path)
    file = tmp_path / "vehicle.toml"
    lines = file.read_text().splitlines()
    kept = [line for line in lines if not line.startswith(("deflection", "force = ["))]
    at = kept.index("[[mount_group.curve]]")
    kept.insert(at + 1, 'file = "curve.csv"')
    text = "\n".join(kept).replace("vertical = 130.0, ", "", 1)
    file.write_text(text + "\n")
    (tmp_path / "curve.csv").write_text("Deflection (mm); Force (kN)\n0; 0\n5; 0,5\n10; 2\n")
    return tmp_path


def curve_of(vehicle: Vehicle):
    return vehicle.mount_groups[0].curves["vertical"]


def test_a_curve_is_read_in_its_own_units_and_says_the_rate(folder):
    vehicle = read_vehicle(folder)
    assert curve_of(vehicle).deflection == pytest.approx(CURVE.deflection)
    assert curve_of(vehicle).force == pytest.approx(CURVE.force)
    assert vehicle.rates["m"].vertical == pytest.approx(1.3 * 100e3)


def test_a_header_without_units_has_those_of_the_vehicle(folder):
    (folder / "curve.csv").write_text("deflection,force\n0,0\n0.005,500\n0.01,2000\n")
    vehicle = read_vehicle(folder)
    assert curve_of(vehicle).force == pytest.approx(CURVE.force)
    assert "curve.csv: column force says no unit: taken in N, the force of [units]" in vehicle.notes


def test_a_vehicle_with_a_tuned_curve_comes_back(folder, tmp_path):
    vehicle = read_vehicle(folder)
    rates = {"m": vehicle.mount_groups[0].bounds[1]}
    write_vehicle(vehicle.with_rates(rates), tmp_path / "again")
    again = read_vehicle(tmp_path / "again")
    assert again.rates["m"].vertical == pytest.approx(4 * 1.3 * 100e3)
    np.testing.assert_array_equal(curve_of(again).force, curve_of(vehicle).force)


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ("0,0\n5,500\n4,600\n", "curve.csv: line 4, column deflection: found 4 after 5, expected more"),
        ("0,0\n5,500\n6,400\n", "curve.csv: line 4, column force: found 400 after 500, expected more"),
        ("0,0\n5,5OO\n", "curve.csv: line 3, column force: found '5OO', expected a number"),
        ("1,0\n5,500\n", "curve.csv: deflection: found 0.001 to 0.005 m, expected from zero"),
        ("0,0\n", "curve.csv: found 1 point, expected two or more"),
        ("", "curve.csv: found 0 points, expected two or more"),
    ],
)
def test_a_wrong_curve_is_told_with_file_line_and_column(folder, lines, words):
    (folder / "curve.csv").write_text("deflection (mm),force (N)\n" + lines)
    with pytest.raises(VehicleError) as error:
        read_vehicle(folder)
    assert "mount_group[0].curve[0].file: " in str(error.value)
    assert words in str(error.value)


def test_a_unit_of_something_else_is_told(folder, capsys):
    (folder / "curve.csv").write_text("deflection (mm),force (mm)\n0,0\n5,500\n")
    assert main(["modes", str(folder)]) == 2
    assert "curve.csv: column force: unknown unit of force 'mm'" in capsys.readouterr().err
