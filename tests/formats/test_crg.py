"""Measured roads in OpenCRG files, and the spectra of their tracks."""

import re
from pathlib import Path

import numpy as np
import pytest
from crg_files import crg

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.formats.roads.crg import Surface, read_crg
from modeviz.formats.roads.tracks import track_spectra
from modeviz.units import INCH

KRC = Path(__file__).parents[3] / "shared/data/s3_pickup_mesh_and_road/krc_rms_course_1in.crg"
V = [-1.0, -0.5, 0.0, 0.5, 1.0]


@pytest.fixture
def read(tmp_path):
    def read(content, name="road.crg"):
        path = tmp_path / name
        path.write_bytes(content)
        return read_crg(path)

    return read


def all_heights(surface):
    """(n_rows, n_sections)."""
    return np.stack([surface.section(i) for i in range(len(surface.v))], axis=1)


def heights(n_rows=30, n_sections=5, seed=1):
    return np.random.default_rng(seed).uniform(-0.2, 0.2, (n_rows, n_sections))


@pytest.mark.parametrize(
    ("data_format", "digits"), [("LRFI", 6), ("LDFI", 15), ("KRBI", 7), ("KDBI", 16)]
)
@pytest.mark.parametrize("numbered", [True, False])
@pytest.mark.parametrize("n_sections", [1, 5, 11])
def test_heights_are_read_of_every_format(read, data_format, digits, numbered, n_sections):
    """Rows of eleven sections go over several records of text."""
    z, v = heights(31, n_sections), np.linspace(-2, 2, n_sections) if n_sections > 1 else [0.5]
    found = read(crg(z, 0.1, v, data_format, numbered=numbered))
    np.testing.assert_allclose(all_heights(found), z, atol=0.6 * 10.0**-digits)
    np.testing.assert_allclose(found.v, v, atol=1e-9)
    assert found.increment == 0.1
    assert found.length == pytest.approx(3.0)


@pytest.mark.parametrize("data_format", ["LRFI", "KRBI"])
def test_without_an_end_there_are_as_many_rows_as_data_and_padding_is_none(read, data_format):
    z = heights(31, 3)
    content = crg(z, 0.1, V[:3], data_format, parameters={"REFERENCE_LINE_END_U": None})
    assert len(all_heights(read(content))) == 31


def test_sections_without_a_border_are_about_the_reference_line(read):
    border = {"LONG_SECTION_V_RIGHT": None, "LONG_SECTION_V_LEFT": None}
    found = read(crg(heights(), 0.1, V, parameters=border))
    np.testing.assert_allclose(found.v, V)
    spread = {"LONG_SECTION_V_INCREMENT": None, "LONG_SECTION_V_LEFT": 3.0}
    np.testing.assert_allclose(read(crg(heights(), 0.1, V, parameters=spread)).v, [-1, 0, 1, 2, 3])


def test_missing_heights_are_no_numbers(read):
    z = heights()
    z[3, 1] = np.nan
    for data_format in ("LRFI", "LDFI", "KRBI", "KDBI"):
        found = all_heights(read(crg(z, 0.1, V, data_format)))
        assert np.argwhere(np.isnan(found)).tolist() == [[3, 1]]


def test_slope_and_banking_of_the_reference_line_are_added(read):
    rng = np.random.default_rng(2)
    slope, banking = rng.uniform(-0.1, 0.1, (2, 30))
    phi = np.zeros(30)
    channels = {
        "reference line phi,rad": phi,
        "reference line slope,m/m": slope,
        "reference line banking,m/m": banking,
    }
    z = heights()
    found = read(crg(z, 0.5, V, "KDBI", channels))
    rise = np.array([slope[1 : i + 1].sum() * 0.5 for i in range(30)])
    np.testing.assert_allclose(all_heights(found), z + rise[:, None] + banking[:, None] * V)
    constant = {"REFERENCE_LINE_START_S": 0.02, "REFERENCE_LINE_START_B": 0.03}
    found = read(crg(z, 0.5, V, "KDBI", parameters=constant))
    expected = z + 0.01 * np.arange(30)[:, None] + 0.03 * np.array(V)
    np.testing.assert_allclose(all_heights(found), expected)


def test_modifiers_scale_a_road_and_zero_does_not(read):
    z = heights()
    scales = {"SCALE_Z_GRID": 2.0, "SCALE_LENGTH": 3.0, "SCALE_WIDTH": 0.5, "SCALE_BANKING": 0}
    found = read(crg(z, 0.5, V, "KDBI", parameters={"REFERENCE_LINE_START_B": 0.1}, modifiers=scales))
    np.testing.assert_allclose(all_heights(found), 2 * z + 0.1 * np.array(V))
    assert found.increment == 1.5
    np.testing.assert_allclose(found.v, np.array(V) / 2)


def test_parameters_that_nothing_depends_on_may_be_anything(read):
    """A sample of the specification has GRID_NAN_MODE = 2.000000000+e00."""
    z = heights()
    found = read(crg(z, 0.5, V, "KDBI", modifiers={"GRID_NAN_MODE": "2.0+e00"}))
    np.testing.assert_allclose(all_heights(found), z)


def test_a_file_that_names_another_is_that_one_with_its_own_modifiers(read, tmp_path):
    (tmp_path / "data").mkdir()
    z = heights()
    (tmp_path / "data" / "other.crg").write_bytes(crg(z, 0.5, V, "KDBI"))
    text = "$CT\n$\n$ROAD_CRG_FILE\n./data/\nother.crg\n$\n$ROAD_CRG_MODS\nSCALE_Z_GRID = 2\n$\n"
    np.testing.assert_allclose(all_heights(read(text.encode())), 2 * z)


def surface(left, right, increment=0.05):
    return Surface(increment, np.array([-2.0, 0.0, 2.0]), np.stack([right, 0 * left, left], axis=1))


def spectra(left, right, width=4.0, increment=0.05):
    return track_spectra(surface(left, right, increment), width, lambda text: None)


def test_a_wave_has_its_power_at_its_frequency():
    """a²/2, in the few lines that a window spreads it over; left is where v is above zero."""
    u = 0.05 * np.arange(8000)
    found = spectra(0.03 * np.cos(2 * np.pi * 0.5 * u), 0.01 * np.sin(2 * np.pi * 2.0 * u))
    n, dn = found.spatial_frequency, found.spatial_frequency[0]
    for track, amplitude, wave in ((0, 0.03, 0.5), (1, 0.01, 2.0)):
        power = found.spectrum[:, track, track].real
        assert n[power.argmax()] == pytest.approx(wave, abs=dn)
        near = np.abs(n - wave) < 4 * dn
        assert power[near].sum() * dn == pytest.approx(amplitude**2 / 2, rel=2e-3)
        assert found.rms[track] == pytest.approx(amplitude / np.sqrt(2), rel=1e-3)


def test_a_right_track_that_lags_has_the_phase_of_its_distance():
    """R(u) = L(u - d), so that S_lr = E[L R*] = S_ll exp(2πi n d)."""
    rough = np.random.default_rng(3).normal(0, 0.01, 40_004)
    found = spectra(rough[4:], rough[:-4])
    n, d = found.spatial_frequency, 4 * 0.05
    ratio = found.spectrum[:, 0, 1] / found.spectrum[:, 0, 0].real
    few = n < 1
    np.testing.assert_allclose(ratio[few], np.exp(2j * np.pi * n[few] * d), atol=0.02)


def test_spectra_of_two_tracks_are_hermitian_and_no_more_coherent_than_one():
    rng = np.random.default_rng(4)
    common, *own = rng.normal(0, 0.01, (3, 20_000))
    found = spectra(common + own[0], common + own[1]).spectrum
    np.testing.assert_allclose(found, found.conj().transpose(0, 2, 1))
    coherence = np.abs(found[:, 0, 1]) ** 2 / (found[:, 0, 0] * found[:, 1, 1]).real
    assert coherence.max() <= 1 + 1e-12
    assert coherence.mean() == pytest.approx(0.25, abs=0.1)


def test_a_road_made_of_an_iso_class_is_found_to_be_that_one():
    """Waves of random phases with the amplitudes of G_d; the mean of many lines is within 10 %."""
    level, increment, n_rows = 256e-6, 0.05, 2**16
    n = np.fft.rfftfreq(n_rows, increment)[1:]
    power = level * (n / 0.1) ** -2.0 * (n > 0.01)
    rng = np.random.default_rng(5)
    tracks = []
    for _ in range(2):
        phases = np.exp(2j * np.pi * rng.uniform(size=len(n)))
        lines = np.sqrt(power * n[0] / 2) * phases * n_rows
        tracks.append(np.fft.irfft(np.concatenate([[0], lines]), n_rows))
    found_level, waviness = spectra(*tracks).fit()
    assert found_level == pytest.approx(level, rel=0.1)
    assert waviness == pytest.approx(2.0, abs=0.05)


def test_tracks_are_between_sections_and_at_the_edges_of_a_narrow_road():
    v = np.array([-1.0, 0.0, 2.0])
    found = Surface(0.1, v, np.array([[1.0, 2.0, 6.0]]))
    expected = {-2: 1, -1: 1, -0.5: 1.5, 0: 2, 1: 4, 1.5: 5, 2: 6, 9: 6}
    assert {at: found.track(at)[0] for at in expected} == pytest.approx(expected)
    notes = []
    rough = np.random.default_rng(6).normal(size=2000)
    assert track_spectra(surface(rough, rough), 5.0, notes.append).width == 4.0
    assert notes == ["the surface is 4 m wide: its edges are taken for tracks that are to be 5 m apart"]


def test_what_is_said_of_a_narrow_road_is_one_thing(tmp_path, capsys):
    path = tmp_path / "road.crg"
    path.write_bytes(GOOD)
    assert main(["import", str(path), "--track-width", "5"]) == 0
    said = capsys.readouterr()
    assert len(said.err.splitlines()) == 1
    assert "tracks 2 m apart over" in said.out
    assert "5 m apart" not in said.out


def test_even_ends_and_unknown_ones_are_left_out_and_small_gaps_bridged():
    rough = np.random.default_rng(7).normal(0, 0.01, 4000)
    plain = spectra(rough, rough)
    notes = []
    ends = np.concatenate([np.zeros(200), rough, np.zeros(300)])
    found = track_spectra(surface(ends, ends), 4.0, notes.append)
    np.testing.assert_allclose(found.rms, plain.rms, rtol=1e-3)
    assert notes == ["9.9 m at its beginning and 14.9 m at its end are even, and left out"]
    ends[:200], ends[-300:], notes[:] = np.nan, np.nan, []
    found = track_spectra(surface(ends, ends), 4.0, notes.append)
    np.testing.assert_allclose(found.spectrum, plain.spectrum, rtol=1e-9)
    assert notes == ["500 cuts at its ends, where heights are missing, are left out"]
    gap, notes[:] = rough.copy(), []
    gap[1000:1004] = np.nan
    found = track_spectra(surface(gap, gap), 4.0, notes.append)
    np.testing.assert_allclose(found.rms, plain.rms, rtol=1e-2)
    assert notes == ["4 heights are missing, and taken between those beside them"]


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (lambda z: z[:100], "has 100 heights along"),
        (lambda z: 0 * z, "has no roughness"),
        (lambda z: z * np.nan, "has no heights where the tracks are"),
        (lambda z: np.where(np.arange(len(z)) // 50 == 5, np.nan, z), "a track over 2.5 m"),
    ],
)
def test_a_road_without_enough_of_one_is_refused(change, expected):
    z = change(np.random.default_rng(8).normal(0, 0.01, 2000))
    with pytest.raises(VehicleError, match=expected):
        spectra(z, z)


TOML = """name = "block"

[units]
length = "in"
mass = "kg"
inertia = "kg m²"
stiffness = "N/mm"

[[rigid_body]]
name = "block"
mass = 100.0
center_of_gravity = [0, 0, 20]
inertia = [5.0, 10.0, 12.0]
"""
TYRE = """
[[tyre]]
name = "{name}"
bodies = ["block", "ground"]
at = [0, {y}, 0]
stiffness = [10, 10, 100]
wheel_center = [0, {y}, 10]
"""


@pytest.fixture
def block(tmp_path):
    """A folder of a vehicle in inches, without tyres."""
    folder = tmp_path / "vehicle"
    folder.mkdir()
    (folder / "vehicle.toml").write_text(TOML)
    return folder


@pytest.fixture
def vehicle(block):
    """The same with tyres 1.5 m apart."""
    y = 0.75 / INCH
    tyres = TYRE.format(name="left", y=-y) + TYRE.format(name="right", y=y)
    (block / "vehicle.toml").write_text(TOML + tyres)
    return block


def put(path, folder, *options) -> int:
    """What `modeviz import` ends with that puts a road into a folder."""
    return main(["import", str(path), "--output", str(folder), *options])


def test_an_imported_road_is_driven_as_it_was_measured(vehicle, tmp_path, capsys):
    """Left is rougher; over a vehicle's speed the power in m²/Hz is G_d(f/V)/V."""
    rng = np.random.default_rng(9)
    z = np.stack([rng.normal(0, 0.01, 8000), np.zeros(8000), rng.normal(0, 0.03, 8000)], axis=1)
    path = tmp_path / "proving ground.crg"
    path.write_bytes(crg(z, 0.05, [-0.75, 0, 0.75], "KDBI"))
    before = (vehicle / "vehicle.toml").read_text()
    assert put(path, vehicle) == 0
    assert (vehicle / "vehicle.toml").read_text().startswith(before)
    said = capsys.readouterr().out
    (road,) = read_vehicle(vehicle).roads
    assert road.name == "proving ground"
    expected = spectra(z[:, 2], z[:, 0])
    np.testing.assert_allclose(road.spectrum, expected.spectrum, rtol=1e-12, atol=1e-20)
    np.testing.assert_allclose(road.frequency_hz / road.speed, expected.spatial_frequency)
    assert re.search(r"tracks 1.5 m apart over 399.95 m: RMS (29|30).* left, (9|10).* right", said)
    assert put(path, vehicle) == 2
    assert "has a road 'proving ground' already" in capsys.readouterr().err
    assert put(path, vehicle, "--name", "again") == 0
    assert [r.name for r in read_vehicle(vehicle).roads] == ["proving ground", "again"]


def test_a_vehicle_without_tyres_needs_the_track_width(block, tmp_path, capsys):
    path = tmp_path / "road.crg"
    path.write_bytes(crg(np.random.default_rng(1).normal(0, 0.01, (2000, 3)), 0.05, [-2, 0, 2]))
    assert put(path, block) == 2
    said = capsys.readouterr().err
    assert "the vehicle has no tyres on both sides" in said
    assert "or say it with --track-width" in said
    assert put(path, block, "--track-width", "0") == 2
    assert "--track-width: found 0 m" in capsys.readouterr().err
    assert put(path, block, "--track-width", "1.4") == 0
    assert len(read_vehicle(block).roads) == 1


@pytest.mark.shared
def test_the_measured_course_has_the_rms_that_is_known_of_it():
    """0.95732 in over u = 100 to 404.75 m, as computed from its bytes; its header says 0.96944 in.

    Its spectra hold that without waves longer than their windows of 76 m.
    """
    course = read_crg(KRC)
    assert all_heights(course).shape == (10096, 3)
    assert course.v.tolist() == [-3, 0, 3]
    u = course.increment * np.arange(10096)
    rough = all_heights(course)[(u > 99.999) & (u < 404.751)]
    rms = np.sqrt(np.mean(rough**2, axis=0)) / INCH
    np.testing.assert_allclose(rms, 0.95732, rtol=1e-4)
    assert rms[0] == pytest.approx(0.96944, rel=0.015)
    found = track_spectra(course, 1.6, lambda text: None)
    assert found.length == pytest.approx(304.8, abs=0.2)
    n, S = found.spatial_frequency, found.spectrum
    power = np.sum(S[:, 0, 0].real) * n[0]
    assert np.sqrt(power) / INCH == pytest.approx(0.95732, rel=0.05)
    np.testing.assert_allclose(S[:, 0, 1], S[:, 0, 0])  # its sections are the same


GOOD = crg(heights(300, 3), 0.1, [-1, 0, 1])
TEXT = crg(heights(300, 3), 0.1, [-1, 0, 1], "LRFI")


def swapped(content):
    """A file with its road data in the other byte order."""
    start = content.index(b"$" * 72) + 73
    return content[:start] + np.frombuffer(content[start:], ">f4").byteswap().tobytes()


def text_crg(old, new):
    assert old in TEXT
    return TEXT.replace(old, new, 1)


BAD = {
    "no file of roads": (b"\x89PNG", "found no section $ROAD_CRG"),
    "nothing": (b"", "found no section $ROAD_CRG"),
    "a header alone": (GOOD[: GOOD.index(b"$$$$")], "has no road data"),
    "cut": (GOOD[:-400], "expected"),
    "cut within a record": (GOOD[:-37], "it is cut, or its line ends were changed"),
    "line ends changed": (GOOD.replace(b"\n", b"\r\n") + b"\r", "its line ends were changed"),
    "another byte order": (swapped(GOOD), "beyond 100000 m"),
    "text for binary": (text_crg(b"#:LRFI", b"#:KRBI"), "expected"),
    "another format": (text_crg(b"#:LRFI", b"#:LRBI"), "found road data in the format 'LRBI'"),
    "no increment": (
        text_crg(b"REFERENCE_LINE_INCREMENT", b"REFERENCE_LINE_INCREMANT"),
        "REFERENCE_LINE_INCREMENT: found 0",
    ),
    "a negative increment": (
        text_crg(b"INCREMENT  = 0.1", b"INCREMENT  = -.1"),
        "expected more than 0",
    ),
    "an increment that is none": (
        text_crg(b"INCREMENT  = 0.1", b"INCREMENT  = nan"),
        "expected a finite number",
    ),
    "an end before the start": (
        text_crg(b"END_U      = 29.9", b"END_U      = -1.0"),
        "expected more than where it starts",
    ),
    "a huge end": (text_crg(b"END_U      = 29.9", b"END_U      = 9e99 !"), "heights, expected at most"),
    "more rows than there are": (
        text_crg(b"END_U      = 29.9", b"END_U      = 31.9"),
        "found 300 lines of road data, expected 320",
    ),
    "an end beyond all numbers before its start": (
        text_crg(b"END_U      = 29.9", b"END_U = -1e308 ! "),
        "found -1e+308, expected more than where it starts",
    ),
    "a scale beyond measure": (
        crg(heights(300, 3), 0.1, [-1, 0, 1], modifiers={"SCALE_Z_GRID": 1e300}),
        "beyond 100000 m",
    ),
    "a width beyond measure": (
        crg(heights(300, 3), 0.1, [-1, 0, 1], modifiers={"SCALE_WIDTH": 1e308}),
        "has long sections beyond 100000 m",
    ),
    "a length beyond measure": (
        crg(heights(300, 3), 0.1, [-1, 0, 1], modifiers={"SCALE_LENGTH": 1e300}),
        "has heights every 1e+299 m",
    ),
    "no sections": (
        text_crg(b"D:long section 1,m\nD:long section 2,m\nD:long section 3,m", b"D:color"),
        "expected some of 'long section",
    ),
    "another unit": (text_crg(b"D:long section 2,m", b"D:long section 2,K"), "expected heights in m"),
    "two sections in one place": (
        text_crg(b"D:long section 2,m", b"D:long section 1,m"),
        "two long sections are at the same v",
    ),
    "a place that is none": (
        text_crg(b"D:long section 2,m", b"D:long section at v = x,m"),
        "found a long section at v = 'x'",
    ),
    "a word for a number": (TEXT[:-12] + b"abcdefghij\n", "in the road data, expected a number"),
    "itself": (b"$ROAD_CRG_FILE\nroad.crg\n$\n", "more than 5 deep"),
    "a file that is not there": (b"$ROAD_CRG_FILE\nother.crg\n$\n", "there is no such file"),
    "a file outside": (
        b"$ROAD_CRG_FILE\n../../road.crg\n$\n",
        "expected a file inside the folder of the road",
    ),
    "a file without end": (b"$ROAD_CRG_FILE\nroad\n$\n", "expected the name of a file, .crg"),
    "no place of sections": (
        crg(
            heights(300, 3),
            0.1,
            [-1, 0, 1],
            parameters={"LONG_SECTION_V_INCREMENT": None, "LONG_SECTION_V_LEFT": None},
        ),
        "LONG_SECTION_V_INCREMENT: missing",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_is_refused_in_one_sentence_and_changes_nothing(vehicle, tmp_path, capsys, name):
    content, expected = BAD[name]
    path = tmp_path / "road.crg"
    path.write_bytes(content)
    before = {p.name: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()}
    assert put(path, vehicle) == 2
    error = capsys.readouterr().err.splitlines()[-1]
    assert "road.crg" in error
    assert expected in error
    assert {p.name: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()} == before


def test_what_is_of_a_body_is_refused_of_a_road(tmp_path, capsys):
    path = tmp_path / "road.crg"
    path.write_bytes(GOOD)
    assert main(["import", str(path), "--units", "mm-t-s"]) == 2
    assert "--units: has no effect on a road; leave it out" in capsys.readouterr().err
    assert main(["import", "cab.unv", "--track-width", "1.6"]) == 2
    assert "--track-width: has no effect on a body; leave it out" in capsys.readouterr().err
