"""Tables of roads as they come: over hertz or along the road, one track or two, with cross or not."""

import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.files.roads import read_road
from modeviz.files.schema.conventions import Conventions
from modeviz.ride.roads import road_spectrum
from modeviz.vehicle.iso_8608 import isotropic_coherence

SPEED, WIDTH = 25.0, 1.5
N = np.geomspace(0.02, 5, 40)
"""Cycles/m."""
LEFT, RIGHT = 2e-6 * N**-2.0, 3e-6 * N**-2.0
"""m²/(cycle/m)."""
CROSS = 1e-6 * N**-2.0 * np.exp(0.3j)


@pytest.fixture
def read(tmp_path):
    """The road in a table of these columns, and the notes on it."""

    def read(columns, speed=None, length="m"):
        lines = [
            ",".join(columns),
            *(",".join(map(repr, r)) for r in np.array([*columns.values()]).T.tolist()),
        ]
        (tmp_path / "r.csv").write_text("\n".join([*lines, ""]), "utf-8")
        notes: list[str] = []
        table = read_road(tmp_path / "r.csv", Conventions({"length": length}), notes.append)
        return table.road("r", "r", speed, WIDTH, notes.append), notes

    return read


def two(frequency, unit="", factor=1.0, values=N):
    """Columns of both tracks and their cross spectrum."""
    names = [
        f"{name}{f' ({unit})' if unit else ''}"
        for name in ("left", "right", "cross_real", "cross_imag")
    ]
    spectra = (LEFT, RIGHT, CROSS.real, CROSS.imag)
    return {frequency: values, **{n: s / factor for n, s in zip(names, spectra, strict=True)}}


@pytest.mark.parametrize(
    "columns",
    [
        two("n (cycles/m)", "m³"),
        two("spatial frequency (cycles/m)", "m²/(cycle/m)"),
        two("Wavenumber [1/m]", "m^2/(cycles/m)"),
        two("n (cycles/m)", "mm²/(cycle/m)", 1e-6),
        two("n (cycles/m)", "cm³", 1e-6),
        two("n (m⁻¹)", "m³/cycle"),
        two("n (cycles/m)", "m²·m"),
        two("wavenumber (rad/m)", "m³/rad", 2 * np.pi, 2 * np.pi * N),
        two("wavenumber (rad/m)", "m²/(rad/m)", 2 * np.pi, 2 * np.pi * N),
        two("wavenumber (rad/m)", "m³", 2 * np.pi, 2 * np.pi * N),
        two("wavenumber (rad/m)", "", 2 * np.pi, 2 * np.pi * N),
        two("wavenumber (rad/m)", "m³/cycle", 1.0, 2 * np.pi * N),
        two("n (cycles/m)"),
    ],
)
def test_a_table_along_the_road_is_that_of_a_vehicle_at_any_speed(read, columns):
    """S(f) = G(f/V)/V, and G per rad/m is 1/2π of that per cycle/m."""
    road, notes = read(columns)
    met, _ = read(two("frequency (Hz)", "m²/Hz", SPEED, SPEED * N), SPEED)
    f = np.array([1.0, 4.0, 30.0])
    for speed in (SPEED, 10.0):
        expected = road_spectrum(met, f, speed)
        np.testing.assert_allclose(road_spectrum(road, f, speed), expected, rtol=1e-9)
    assert notes == []


def test_lengths_of_a_table_without_units_are_the_vehicles(read):
    road, _ = read(two("n (cycles/m)", factor=1e-9), length="mm")
    np.testing.assert_allclose(road.spectrum[:, 0, 0].real, LEFT, rtol=1e-12)


@pytest.mark.parametrize("name", ["track", "left", "right"])
def test_one_track_is_both_of_a_surface_alike_in_all_directions(read, name):
    road, (note,) = read({"n (cycles/m)": N, f"{name} (m³)": 2e-6 * N**-2.4})
    S = road.spectrum
    assert np.array_equal(S[:, 0, 0], S[:, 1, 1])
    ratio = (S[:, 0, 1] / S[:, 0, 0]).real
    np.testing.assert_allclose(ratio, isotropic_coherence(N, WIDTH, 2.4), rtol=1e-6)
    assert "without a cross spectrum the tracks are taken as two" in note
    assert "1.5 m apart, of waviness 2.4" in note


def test_what_was_met_at_a_speed_has_the_coherence_of_the_road(read):
    road, _ = read({"frequency_hz": SPEED * N, "left (m²/Hz)": LEFT, "right (m²/Hz)": RIGHT}, SPEED)
    ratio = road.spectrum[:, 0, 1].real / np.sqrt(LEFT * RIGHT)
    np.testing.assert_allclose(ratio, isotropic_coherence(N, WIDTH, 2.0), rtol=1e-6)


def test_a_coherence_is_squared_and_has_no_phase(read):
    squared = np.linspace(1.0, 0.0, len(N))
    road, notes = read({"n (cycles/m)": N, "left": LEFT, "right": RIGHT, "coherence": squared})
    np.testing.assert_allclose(road.spectrum[:, 0, 1], np.sqrt(squared * LEFT * RIGHT), rtol=1e-12)
    assert notes == []


def test_a_row_at_zero_is_left_out_and_said(read):
    columns = {k: np.concatenate([[0.0], v]) for k, v in two("n (cycles/m)", "m³").items()}
    road, notes = read(columns)
    assert road.frequency_hz[0] == N[0]
    assert notes == ["r.csv: line 2: n = 0 is left out, since spectra are known above zero only"]


@pytest.mark.parametrize(
    ("columns", "speed", "words"),
    [
        ({"n": N, "track": LEFT}, None, "column n: found the unit '', expected one of cycles/m"),
        ({"n (cycles/km)": N, "track": LEFT}, None, "column n: found the unit 'cycles/km'"),
        ({"n (cycles/m)": N, "track (m²/Hz)": LEFT}, None, "column track: found the unit 'm²/Hz'"),
        ({"n (cycles/m)": N, "track (m²)": LEFT}, None, "column track: found the unit 'm²'"),
        (
            {"n (cycles/m)": np.array([0.0, 0.0, 1.0]), "track": LEFT[:3]},
            None,
            "line 3, column n: found 0.0 after 0, expected rising values",
        ),
        ({"track (m³)": LEFT}, None, "expected one column of frequencies"),
        ({"n (cycles/m)": N, "frequency_hz": N, "track": LEFT}, None, "expected one column of freq"),
        ({"n (cycles/m)": N}, None, "without left and right"),
        ({"n (cycles/m)": N, "track": LEFT, "left": LEFT, "right": LEFT}, None, "one track beside two"),
        ({"n (cycles/m)": N, "track": LEFT, "coherence": 0 * N}, None, "without left and right"),
        ({"n (cycles/m)": N, "left": LEFT, "right": LEFT, "cross_real": N}, None, "with cross_real"),
        (
            {"n (cycles/m)": N, "left": LEFT, "right": LEFT, "coherence": 0 * N + 1.2},
            None,
            "line 2, column coherence: found 1.2, expected 0 to 1",
        ),
        ({"n (cycles/m)": N, "track": LEFT}, SPEED, "speed: r.csv is over cycles/m, which need none"),
        ({"frequency_hz": N, "track": LEFT}, None, "speed: missing, expected that at which r.csv"),
    ],
)
def test_what_is_no_table_of_a_road_is_told_what_would_be(read, columns, speed, words):
    with pytest.raises(VehicleError) as refused:
        read(columns, speed)
    assert words in str(refused.value)
