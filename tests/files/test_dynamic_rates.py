"""Rates over frequency in a vehicle folder: tables of test rigs, formulas, and what is wrong there."""

from pathlib import Path

import numpy as np
import pytest
from dynamic_mounts import HYDRAULIC, MAXWELL, measured, on_mounts

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.rate_tables import read_rate_table, write_rate_table
from modeviz.files.schema.conventions import Conventions
from modeviz.vehicle.dynamic_rates import RateTable

UNITS = Conventions({"stiffness": "N/mm", "length": "mm"})


def read(
    path: Path, text: str, reference_hz: float = 10.0, amplitude: float | None = None
) -> RateTable:
    file = path / "rubber.csv"
    file.write_text(text, "utf-8")
    return read_rate_table(file, reference_hz, amplitude, UNITS, lambda note: None)


def test_a_rig_writes_magnitude_and_loss_angle(tmp_path):
    table = read(tmp_path, "frequency (Hz),stiffness (N/mm),loss angle (deg)\n1,200,5\n20,300,10\n")
    angles = np.radians([5, 10])
    expected = np.array([200e3, 300e3]) * np.exp(1j * angles)
    assert np.allclose(table.rates, expected[:, None], rtol=1e-14)
    assert table.frequency_hz.tolist() == [1, 20]


def test_a_loss_factor_stands_beside_magnitude_or_storage(tmp_path):
    text = "frequency_hz,vertical_stiffness,vertical_loss_factor,lateral_storage,lateral_loss_factor\n"
    table = read(tmp_path, text + "1,200,0.1,200,0.1\n")
    assert np.abs(table.rates[0, 2]) == pytest.approx(200e3, rel=1e-14)
    assert table.rates[0, 1] == pytest.approx(200e3 * (1 + 0.1j), rel=1e-14)


def test_directions_without_a_loss_have_that_of_the_first_with_one(tmp_path):
    table = read(
        tmp_path,
        "frequency_hz,vertical_ratio,vertical_loss_angle (rad),lateral_ratio\n5,1,0.1,1\n20,2,0.3,3\n",
        reference_hz=20.0,
    )
    g = np.tan(0.3)
    assert np.allclose(table.rates[:, 1], np.array([1, 3]) * (1 + 1j * g))
    assert np.allclose(table.rates[:, 0], 1 + 1j * g)
    assert table.loss_factor == pytest.approx(g)


def test_one_amplitude_is_taken_of_several(tmp_path):
    text = "frequency_hz,amplitude (mm),storage\n1,0.1,300\n9,0.1,400\n1,1,200\n9,1,250\n"
    assert read(tmp_path, text, amplitude=1e-3).rates[:, 0].tolist() == [200e3, 250e3]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "frequency_hz,stiffness,loss_angle\n1,2,3\n",
            "loss_angle: found no unit, expected",
        ),
        ("frequency_hz,stiffness,loss_angle (deg)\n1,2,200\n", "line 2, column loss_angle: found 200"),
        ("frequency_hz,stiffness (kg)\n1,2\n", "column stiffness: unknown unit of stiffness 'kg'"),
        ("frequency_hz,stiffness\n2,200\n1,200\n", "line 3, column frequency_hz: found 1 after 2"),
        ("frequency_hz,stiffness\n1,-200\n", "line 2, column stiffness: found -200, expected zero or"),
        ("frequency_hz,stiffness\n", "found no lines below the header"),
        ("frequency_hz,loss_factor\n1,0.1\n", "found loss_factor, expected one of stiffness, ratio"),
        ("frequency_hz,stiffness,ratio\n1,2,1\n", "found stiffness, ratio, expected one of"),
        ("frequency_hz,stiffness,loss\n1,2,1\n", "found stiffness beside loss, expected storage"),
        ("frequency_hz,ratio (N/mm)\n1,1\n", "column ratio: found the unit 'N/mm', expected none"),
        ("frequency_hz,amplitude,ratio\n1,1,1\n1,2,1\n", "amplitude: found none, expected one of the"),
        ("frequency_hz,stiffness\n1,0\n9,0\n", "expected more than 0"),
        ("frequency_hz\n1\n", "expected stiffness, ratio or storage"),
    ],
)
def test_a_wrong_table_is_refused_in_a_sentence(tmp_path, text, words):
    with pytest.raises(VehicleError) as refused:
        read(tmp_path, text)
    assert words in str(refused.value)
    assert "rubber.csv" in str(refused.value)


@pytest.mark.bitwise
@pytest.mark.parametrize("rubber", [MAXWELL, HYDRAULIC, measured(HYDRAULIC)])
def test_a_written_vehicle_reads_back_to_the_same_frequencies(tmp_path, rubber):
    vehicle = on_mounts(rubber)
    write_vehicle(vehicle, tmp_path / "written")
    read_back = read_vehicle(tmp_path / "written")
    was, now = (solve_modal(prepare_modes(v), {}).modes.frequency_hz for v in (vehicle, read_back))
    assert now.tolist() == was.tolist()


def test_a_table_that_is_not_there_is_named(tmp_path):
    write_vehicle(on_mounts(measured(MAXWELL)), tmp_path / "folder")
    (tmp_path / "folder/rates/e.csv").unlink()
    with pytest.raises(VehicleError, match=r"mount_group\[0\]\.dynamic\.file.*e\.csv"):
        read_vehicle(tmp_path / "folder")


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (
            'file = "rates/e.csv"\nthree_parameter = {stiffening = [1, 1, 1], corner = 5}',
            "found file and",
        ),
        ("amplitude = 0.1", "found none, expected one of file"),
        ("three_parameter = {stiffening = [-1, 1, 1], corner = 5}", "expected zero or more"),
    ],
)
def test_wrong_keys_are_refused(tmp_path, wrong, words):
    write_vehicle(on_mounts(measured(MAXWELL)), tmp_path / "folder")
    file = tmp_path / "folder/vehicle.toml"
    file.write_text(file.read_text("utf-8").replace('file = "rates/e.csv"', wrong), "utf-8")
    with pytest.raises(VehicleError, match="dynamic") as refused:
        read_vehicle(tmp_path / "folder")
    assert words in str(refused.value)


def test_an_amplitude_that_was_chosen_is_known_and_written(tmp_path):
    text = "frequency_hz,amplitude (mm),storage\n1,0.1,300\n9,0.1,400\n1,1,200\n9,1,250\n"
    table = read(tmp_path, text, amplitude=1e-3)
    assert table.amplitude == pytest.approx(1e-3)
    write_rate_table(tmp_path / "again.csv", table)
    again = read_rate_table(tmp_path / "again.csv", 10.0, None, UNITS, lambda note: None)
    assert again.amplitude == table.amplitude
    assert read(tmp_path, "frequency_hz,ratio\n1,1\n").amplitude is None


def test_units_that_are_not_said_are_told(tmp_path):
    notes = []
    file = tmp_path / "rubber.csv"
    file.write_text("frequency_hz,amplitude,vertical_storage,lateral_storage\n1,0.1,300,200\n", "utf-8")
    read_rate_table(file, 10.0, None, UNITS, notes.append)
    assert notes == [
        "rubber.csv: column amplitude says no unit: taken in mm, the length of [units]",
        "rubber.csv: columns vertical_storage, lateral_storage say no unit: taken in N/mm, the "
        "stiffness of [units]",
    ]
