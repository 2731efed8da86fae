"""Frequency responses and spectra that are written are those of the vehicle, as pyuff reads them."""

import csv
from dataclasses import replace

import numpy as np
import pytest
import pyuff
from mounted_cabin import mounted_cabin
from turned_vehicles import turned_folder

from modeviz.dynamics.assembly import assemble
from modeviz.errors import ModevizError
from modeviz.export.axes import FileAxes
from modeviz.export.functions import Function, Functions, Input
from modeviz.export.universal.functions import functions_file
from modeviz.study.study import Study
from modeviz.units import STANDARD_GRAVITY

DIGITS = 5.1e-6
"""Relative: half of the sixth digit of a frequency that is written."""


@pytest.fixture(scope="module")
def study():
    return Study(mounted_cabin())


def functions(path):
    return [one for one in pyuff.UFF(str(path)).read_sets() if one["type"] == 58]


def table(path):
    with path.open(encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    return dict(zip(header, np.array(rows, float).T, strict=True))


@pytest.mark.parametrize("ending", [".uff", ".unv"])
def test_spectra_are_those_of_the_ride_in_si(study, tmp_path, ending):
    ride = study.ride("rough")
    found = functions(study.export(tmp_path / f"psd{ending}", road="rough").path)
    assert [(f["rsp_node"], f["rsp_dir"], f["func_type"]) for f in found] == [
        (1, axis, 9) for axis in (1, 2, 3)
    ]
    for one, direction in zip(found, ("fore-aft", "lateral", "vertical"), strict=True):
        expected = ride.psd("seat", direction) * STANDARD_GRAVITY**2
        np.testing.assert_allclose(one["data"], expected, rtol=1e-11)
        np.testing.assert_allclose(one["x"], ride.frequency_hz, rtol=DIGITS)
        assert f"seat {direction} ({'xyz'[one['rsp_dir'] - 1]})" in one["id1"]
        assert "rough at 20 m/s; (m/s^2)^2/Hz" in one["id2"]


def test_a_table_of_spectra_has_what_is_printed_and_says_units(study, tmp_path):
    ride = study.ride()
    found = table(study.export(tmp_path / "psd.csv").path)
    np.testing.assert_array_equal(found["frequency [Hz]"], ride.frequency_hz)
    np.testing.assert_allclose(
        found["seat vertical (z) [g^2/Hz]"], ride.psd("seat", "vertical"), rtol=1e-14
    )
    assert len(found) == 4


def direct(vehicle, f, force):
    """Acceleration x, y, z of the seat, (n_freqs, 3), by all equations of motion, m/s²."""
    system = assemble(vehicle)
    (point,) = vehicle.response_points
    rows = system.motion(point.body, point.position)[:3]
    K = system.stiffness + 1j * system.structural_damping
    omega = 2 * np.pi * f[:, None, None]
    Z = K + 1j * omega * system.damping - omega**2 * system.mass
    return (
        -((2 * np.pi * f[:, None]) ** 2) * (rows @ np.linalg.solve(Z, force(system))[..., 0:1])[..., 0]
    )


def wheel_force(system):
    """One newton up at the first wheel's centre."""
    tyre = system.vehicle.tyres[0]
    return system.motion("chassis", tyre.wheel_center)[2][:, None]


def test_a_response_to_a_wheel_load_is_that_of_one_newton(study, tmp_path):
    """Whatever amplitude the vehicle's own load has."""
    found = [f for f in functions(study.export(tmp_path / "frf.uff").path) if "radial" in f["id1"]]
    f = table(study.export(tmp_path / "frf.csv").path)["frequency [Hz]"]
    expected = direct(study.vehicle, f, wheel_force)
    assert [one["rsp_dir"] for one in found] == [1, 2, 3]
    for one, along in zip(found, expected.T, strict=True):
        np.testing.assert_allclose(one["data"], along, rtol=1e-6, atol=1e-9)
        assert (one["func_type"], one["orddenom_spec_data_type"]) == (4, 13)


def test_responses_to_both_tracks_make_the_spectrum_of_the_road(study, tmp_path):
    """S = |H_l|² S_l + |H_r|² S_r, for the tracks of this road have nothing in common."""
    found = table(study.export(tmp_path / "frf.csv", road="flat").path)
    ride, f = study.ride("flat"), found["frequency [Hz]"]
    (road,) = (road for road in study.vehicle.roads if road.name == "flat")
    power = 0.0
    for track, number in (("left", 0), ("right", 1)):
        name = f"seat lateral (y) / flat, {track} track"
        H = [found[f"{name}, {part} [(m/s^2)/(m)]"] for part in ("real", "imaginary")]
        S = np.interp(
            np.log(f), np.log(road.frequency_hz), np.log(road.spectrum[:, number, number].real)
        )
        power = power + (H[0] ** 2 + H[1] ** 2) * np.exp(S)
    np.testing.assert_allclose(power, ride.psd("seat", "lateral") * STANDARD_GRAVITY**2, rtol=1e-6)


def test_directions_are_those_of_the_vehicles_file(study, tmp_path):
    """With x forward, y left, z up: a lateral response is against y, and up stays up."""
    words = ("forward", "left", "up")
    turned = Study(turned_folder(tmp_path / "turned", mounted_cabin(), words))
    ours, theirs = (
        table(each.export(tmp_path / f"{i}-frf.csv").path) for i, each in enumerate((study, turned))
    )
    assert list(ours) == list(theirs)
    for name, values in ours.items():
        sign = -1 if "(x)" in name or "(y)" in name else 1
        np.testing.assert_allclose(theirs[name], sign * values, rtol=1e-6, atol=1e-9)


def test_a_vehicle_that_nothing_excites_is_told_so(tmp_path):
    still = replace(mounted_cabin(), wheel_loads=(), roads=(), connections=())
    with pytest.raises(ModevizError, match=r"has no load: give its vehicle.toml a \[\[tyre\]\]"):
        Study(still).export(tmp_path / "frf.csv")
    with pytest.raises(ModevizError, match="has no road"):
        Study(still).export(tmp_path / "psd.csv")
    for name in ("frf.uff", "psd.uff"):
        with pytest.raises(ModevizError, match="has no response point"):
            Study(replace(mounted_cabin(), response_points=())).export(tmp_path / name)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("f", [np.arange(1, 8) / 4, np.array([0.5, 0.7, 1.5, 1.6, 9.0])])
@pytest.mark.parametrize("n_inputs", [0, 2])
def test_any_numbers_at_even_and_uneven_frequencies_come_back(tmp_path, f, n_inputs):
    rng, vehicle = np.random.default_rng(5), mounted_cabin()
    inputs = [Input(name, "displacement", 3) for name in ("left", "right")][:n_inputs]
    values = rng.standard_normal((6, len(f))) * 10.0 ** rng.integers(-30, 30, (6, len(f)))
    made = tuple(
        Function(0, axis, values[2 * axis] + 1j * values[2 * axis + 1], one)
        for one in inputs
        for axis in range(3)
    ) or tuple(Function(0, axis, np.abs(values[axis])) for axis in range(3))
    (tmp_path / "made.uff").write_bytes(
        functions_file(Functions(vehicle, FileAxes(vehicle.axes), "test", f, made))
    )
    found = functions(tmp_path / "made.uff")
    assert len(found) == len(made)
    for one, function in zip(found, made, strict=True):
        np.testing.assert_allclose(one["x"], f, rtol=DIGITS)
        np.testing.assert_allclose(one["data"], function.values, rtol=1e-12)
        assert one["rsp_dir"] == function.axis + 1
    references = [(one["ref_node"], one["ref_dir"]) for one in found]
    assert references == ([(1, 1), (1, 2), (1, 3)] if not inputs else [(2, 3)] * 3 + [(3, 3)] * 3)
