import numpy as np
import pytest
from mounted_cabin import mounted_cabin

from modeviz.analysis.preparation import prepare
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.report.records import wheels_record
from modeviz.report.tables import wheels_table

FREQUENCY_HZ = np.array([11.0, 13.0, 16.0])


def solved():
    vehicle = mounted_cabin()
    return vehicle, solve_wheels(prepare(vehicle, FREQUENCY_HZ), {})


def test_harmonic_response_is_in_g_and_in_decibels_of_it():
    (load,) = wheels_record(*solved())["loads"]
    for response in load["responses"]:
        peak = np.array(response["acceleration_g"])
        np.testing.assert_allclose(response["acceleration_db"], 20 * np.log10(peak), atol=1e-9)


def test_the_table_has_the_mean_and_the_highest_of_the_band():
    vehicle, results = solved()
    vertical = results.acceleration_g[:, 0, 0, 2]
    (line,) = [row for row in wheels_table(vehicle, results).splitlines() if "radial" in row]
    mean, highest = line.split()[4:6]
    assert float(mean) == pytest.approx(1000 * vertical.mean(), abs=0.0051)
    assert float(highest.strip("()")) == pytest.approx(20 * np.log10(vertical.max()), abs=0.051)
