"""The band of a vehicle: its own, and as much of it as a road is known in."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.dynamics.basis import REACH
from modeviz.errors import VehicleError
from modeviz.report.coverage import band_text, coverage_note
from modeviz.report.records import psd_record
from modeviz.report.tables import psd_table
from modeviz.vehicle.loads import Force, Spectrum


def test_a_vehicle_has_the_lines_and_modes_of_its_own_band():
    prepared = prepare(replace(mounted_cabin(), highest_frequency=50.0, frequency_step=0.25))
    assert prepared.frequency_hz[[0, -1]].tolist() == [0.25, 50.0]
    assert prepared.basis.top_hz == pytest.approx(50.0)
    assert band_text(solve(prepared, {}, Conditions("flat", 20.0))) == "0.25 to 50 Hz"


def test_a_road_answers_for_the_part_that_its_table_holds_and_says_so():
    whole = prepare(mounted_cabin())
    results = solve(whole, {}, Conditions("flat", 10.0))
    assert results.frequency_hz[-1] == pytest.approx(30.0)
    assert np.isfinite(results.rms).all()
    assert results.rms[0, 2] > 0
    assert "to 30 Hz at 36 km/h: the answer is for this part" in coverage_note(results)
    assert "RMS 0.1 to 30 Hz" in psd_table(results)
    assert psd_record(results)["known_hz"] == [0.1, 30.0]
    assert not coverage_note(solve(whole, {}, Conditions("flat", 20.0)))


def test_a_rating_says_of_which_part_of_its_band_it_is():
    whole, short = mounted_cabin(), replace(mounted_cabin(), highest_frequency=30.0)
    on_road = solve(prepare(whole), {}, Conditions("flat", 10.0))
    for results in (on_road, solve(prepare(short), {}, Conditions("flat", 20.0))):
        assert "of 0.1 to 30 Hz only" in results.rating.note
        assert f"({results.rating.note})" in psd_table(results)
        assert psd_record(results)["rating"]["note"] == results.rating.note
    assert "Hz only" not in solve(prepare(whole), {}, Conditions("flat", 20.0)).rating.note


def test_a_force_is_known_in_a_part_at_any_speed():
    cabin = mounted_cabin()
    seat = cabin.response_points[0]
    known = Spectrum(np.array([1.0, 20.0]), np.ones(2))
    shaker = Force("shaker", seat.body, seat.position, np.array([0.0, 0.0, 1.0]), known)
    results = solve(prepare(replace(cabin, forces=(shaker,))), {}, Conditions("shaker", 10.0))
    assert "shaker is known from 1 to 20 Hz: the answer is for this part" in coverage_note(results)
    assert "of 1 to 20 Hz only" in results.rating.note


@pytest.mark.parametrize(
    "band",
    [{"frequency_step": 1e-4}, {"frequency_step": 7.0}, {"highest_frequency": np.inf}],
)
def test_a_band_that_cannot_be_is_refused(band):
    with pytest.raises(VehicleError, match="frequency"):
        replace(mounted_cabin(), **band)


@pytest.mark.parametrize("direction", ["vertical", "lateral", "fore-aft"])
def test_modes_above_the_band_have_the_part_in_a_peak_that_a_wider_band_gives_them(direction):
    """Within what damping couples, which for modes above the band is left out."""
    top = 10.5
    short, wide = (
        solve(prepare(replace(mounted_cabin(), highest_frequency=f)), {}, Conditions("flat", 20.0))
        for f in (top, 20.0)
    )
    found, expected = (
        results.peaks(0, direction, 5, [int(np.abs(results.frequency_hz - top).argmin())])[
            0
        ].contributors
        for results in (short, wide)
    )
    assert any((short.part_frequency(c.mode) or 0) > top for c in found)
    for ours, true in zip(found, expected, strict=True):
        f = wide.part_frequency(true.mode)
        if f < REACH * top:
            assert short.part_frequency(ours.mode) == pytest.approx(f, rel=1e-6)
        else:
            assert short.part_name(ours.mode) == "static rest"
        assert ours.ratio == pytest.approx(true.ratio, abs=0.01)
