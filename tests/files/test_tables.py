"""Tables as spreadsheets and editors leave them: one reader for roads and rates."""

from pathlib import Path

import numpy as np
import pytest
from folders import one_of_everything

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.rate_files import parse_rates, read_rates
from modeviz.files.roads import read_road
from modeviz.files.schema.conventions import Conventions
from modeviz.files.tables import read_table
from modeviz.vehicle.loads import Road
from modeviz.vehicle.mount_rates import MountRates

HEADER = "frequency_hz,left,right,cross_real,cross_imag\n"
PLAIN = HEADER + "0.5,1.5e-6,2.5e-6,1e-6,-1e-7\n40,1e-9,1e-9,0,0\n"

AS_LEFT_BY = {
    "bom": "\ufeff" + PLAIN,
    "windows": PLAIN.replace("\n", "\r\n"),
    "old mac": PLAIN.replace("\n", "\r"),
    "empty last lines": PLAIN + "\n\r\n   \n",
    "rows of commas": PLAIN + ",,,,\n,,,,\n",
    "empty lines before and between": "\n" + PLAIN.replace("\n40", "\n\n40"),
    "columns of nothing": PLAIN.replace("\n", ",,\n"),
    "spaces": PLAIN.replace(",", " , "),
    "quotes": PLAIN.replace("left", '"left"').replace("1.5e-6", '"1.5e-6"'),
    "spaces around quotes": PLAIN.replace("left", ' "left" ').replace("1e-9,0", '1e-9 , "0" '),
    "semicolons": PLAIN.replace(",", ";"),
    "decimal commas": PLAIN.replace(",", ";").replace(".", ","),
    "quoted decimal commas": PLAIN.replace(",", ";").replace("1.5e-6", '"1,5e-6"'),
    "tabs": PLAIN.replace(",", "\t").replace(".", ","),
    "sep=": "sep=;\n" + PLAIN.replace(",", ";"),
    "units": PLAIN.replace("frequency_hz", '"Frequency (Hz)"')
    .replace("left", '"Left [m²/Hz]"')
    .replace("right", "right (m^2/Hz)")
    .replace("cross_real", "Cross Real (m2 / Hz)"),
    "columns in another order": "left,cross_imag,cross_real,frequency_hz,right\n"
    "1.5e-6,-1e-7,1e-6,0.5,2.5e-6\n1e-9,0,0,40,1e-9\n",
    "no last line end": PLAIN.rstrip("\n"),
    "capital letters": PLAIN.upper(),
}


def road(path: Path, notes: list[str] | None = None, units: dict[str, str] | None = None) -> Road:
    told = [] if notes is None else notes
    table = read_road(path, Conventions(units or {"length": "m"}), told.append)
    return table.road("r", "r", 20.0, 1.6, told.append)


@pytest.mark.parametrize("case", AS_LEFT_BY)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "cp1252"])
def test_a_road_is_read_as_it_was_left(tmp_path, case, encoding):
    text = AS_LEFT_BY[case]
    if encoding != "utf-8":
        text = text.removeprefix("\ufeff")
    (tmp_path / "plain.csv").write_text(PLAIN, encoding="utf-8", newline="")
    (tmp_path / "r.csv").write_text(text, encoding=encoding, newline="")
    found, expected = road(tmp_path / "r.csv"), road(tmp_path / "plain.csv")
    np.testing.assert_array_equal(found.frequency_hz, expected.frequency_hz)
    np.testing.assert_array_equal(found.spectrum, expected.spectrum)


@pytest.mark.parametrize("case", ["\ufeff{}", "{}\n\n", "{},,\n", "sep=,\n{}"])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_rates_are_read_as_they_were_left(case, separator):
    point = "." if separator == "," else ","
    cells = [["Group", "units", "vertical", "lateral", "fore-aft"]]
    cells += [["C1", "N/mm", f"1{point}5", "2", "3e2"]]
    text = case.replace("sep=,", f"sep={separator}").replace(",,", 2 * separator)
    text = text.format("\r\n".join(separator.join(row) for row in cells))
    assert parse_rates(text, "csv", VEHICLE) == {"C1": MountRates(1.5e3, 2e3, 3e5)}


VEHICLE = one_of_everything()


def test_rates_may_have_their_unit_in_the_header():
    text = '"group";"vertical (N/mm)";"lateral [N/m]";"fore_aft (N/cm)"\n"C1";1,5;2;3\n'
    assert parse_rates(text, "csv", VEHICLE) == {"C1": MountRates(1.5e3, 2.0, 300.0)}
    with pytest.raises(VehicleError, match="line 2, column units: unknown unit of stiffness ''"):
        parse_rates("group,vertical,lateral,fore_aft\nC1,1,2,3\n", "csv", VEHICLE)
    with pytest.raises(VehicleError, match=r"line 2, column lateral: unknown unit of stiffness 'kg'"):
        parse_rates("group,vertical (N/m),lateral (kg),fore_aft (N/m)\nC1,1,2,3\n", "csv", VEHICLE)


def test_a_row_at_zero_hertz_is_left_out_and_said(tmp_path):
    (tmp_path / "r.csv").write_text(PLAIN.replace("\n", "\n0,#DIV/0!,1,0,0\n", 1), "utf-8")
    notes: list[str] = []
    assert road(tmp_path / "r.csv", notes).frequency_hz[0] == 0.5
    assert notes == ["r.csv: line 2: 0 Hz is left out, since spectra are known above zero only"]


def test_a_last_line_without_an_end_is_said(tmp_path):
    (tmp_path / "r.csv").write_text(PLAIN.rstrip("\n"), "utf-8")
    notes: list[str] = []
    road(tmp_path / "r.csv", notes)
    assert notes == ["r.csv: the last line does not end; the file may be cut"]


@pytest.mark.parametrize(("length", "metre"), [("mm", 1e-3), ("in", 0.0254)])
def test_spectra_are_in_the_vehicles_length_squared_or_say_theirs(tmp_path, length, metre):
    (tmp_path / "r.csv").write_text(PLAIN, "utf-8")
    expected = road(tmp_path / "r.csv").spectrum
    found = road(tmp_path / "r.csv", units={"length": length}).spectrum
    np.testing.assert_allclose(found, expected * metre**2, rtol=1e-14)
    header = PLAIN
    for column in ("left", "right", "cross_real", "cross_imag"):
        header = header.replace(column, f"{column} ({length}²/Hz)")
    (tmp_path / "r.csv").write_text(header, "utf-8")
    found = road(tmp_path / "r.csv", units={"length": "m"}).spectrum
    np.testing.assert_allclose(found, expected * metre**2, rtol=1e-14)


def test_coherence_of_one_in_five_digits_is_one(tmp_path):
    """S_lr = √(S_l S_r) e^{jφ}, each number written with five digits, is above one half of the time."""
    rng = np.random.default_rng(5)
    f = np.arange(1, 401) / 10
    left, right = rng.lognormal(-12, 1, (2, 400))
    S_lr = np.sqrt(left * right) * np.exp(1j * rng.uniform(0, 7, 400))
    rows = zip(f, left, right, S_lr.real, S_lr.imag, strict=True)
    lines = [",".join(f"{number:.4e}" for number in row) for row in rows]
    (tmp_path / "r.csv").write_text("\n".join([HEADER.strip(), *lines, ""]), "utf-8")
    S = road(tmp_path / "r.csv").spectrum
    np.testing.assert_allclose(S[:, 0, 1], S_lr, rtol=3e-4)
    coherence = np.abs(S[:, 0, 1]) ** 2 / (S[:, 0, 0] * S[:, 1, 1]).real
    assert coherence.max() < 1 + 1e-12
    assert coherence.min() > 1 - 4e-4


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"PK\x03\x04\x14\x00\x06\x00", "found no text, such as in a workbook"),
        (HEADER.encode(), "found 0 lines above 0 Hz, expected two or more"),
        ((HEADER + "1,1,1,0,0\n").encode(), "found 1 line above 0 Hz, expected two or more"),
    ],
)
def test_a_file_without_a_road_is_refused(tmp_path, content, words):
    (tmp_path / "r.csv").write_bytes(content)
    with pytest.raises(VehicleError, match=words):
        road(tmp_path / "r.csv")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "line 1: found '', without a, b; expected the columns a, b and, if wanted, c"),
        ("a;b\n1.234,5;2\n", "line 2, column a: found '1.234,5', expected a number"),
        ("\n\na,b\n\n1,x\n", "line 5, column b: found 'x', expected a number"),
        ("a,b\n1\n", "line 2: found 1 cells, expected 2"),
        ("a,b\n1,2,3\n", "line 2: found 3 cells, expected 2"),
        ('a,b\n1,"2\n', "line 2: not CSV: a quote does not end, or something stands behind it"),
        ("a,b\n" + "1" * 20_000, "line 2: found 20,000 letters, expected at most 10,000"),
        ("a,b,d\n", "line 1: unknown column 'd': there are a, b, c"),
    ],
)
def test_a_wrong_table_is_explained_with_line_and_column(text, words):
    def numbers():
        return [(r.number("a"), r.number("b")) for r in read_table(text, ("a", "b"), ("c",)).rows]

    with pytest.raises(VehicleError) as caught:
        numbers()
    assert str(caught.value).startswith(words)


@pytest.mark.parametrize("mark", ["utf-8-sig", "utf-16"])
def test_text_files_may_begin_with_a_byte_order_mark(tmp_path, printed_json, mark):
    write_vehicle(VEHICLE, tmp_path / "a")
    file = tmp_path / "a" / "vehicle.toml"
    file.write_text(file.read_text("utf-8"), mark)
    assert read_vehicle(tmp_path / "a").name == VEHICLE.name
    rates = '{"units": "N/m", "rates": {"C1": {"vertical": 1, "lateral": 2, "fore_aft": 3}}}'
    (tmp_path / "r.json").write_text(rates, mark)
    assert read_rates(tmp_path / "r.json", VEHICLE) == {"C1": MountRates(1.0, 2.0, 3.0)}


def test_a_vehicle_with_a_spreadsheets_road_is_driven(tmp_path, capsys, folder):
    write_vehicle(read_vehicle(Path(folder)), tmp_path / "a")
    path = tmp_path / "a" / "roads" / "flat.csv"
    text = path.read_text("utf-8").replace(",", ";").replace(".", ",")
    path.write_text("\ufeff" + text.replace("\n", ";;\r\n") + ";;;;;;\r\n\r\n", "utf-8", newline="")
    assert main(["psd", str(tmp_path / "a")]) == 0
    ours = capsys.readouterr().out
    assert main(["psd", folder]) == 0
    assert capsys.readouterr().out == ours


@pytest.mark.parametrize(
    ("cell", "words"),
    [
        ("1.500,0", "expected a number without marks between its thousands, 1500,0"),
        ("1.500.000", "without marks between its thousands, 1500000"),
        ("1 500,5", "without marks between its thousands, 1500,5"),
        ("1'500", "without marks between its thousands, 1500"),
        ("1.500", "found '1.500' beside decimal commas, expected 1500 or 1,500"),
    ],
)
def test_marks_between_thousands_are_refused_with_the_number_that_is_meant(cell, words):
    (row,) = read_table(f"a;b\n{cell};0,5\n", ["a", "b"]).rows
    with pytest.raises(VehicleError, match=words):
        row.number("a")


def test_points_and_commas_that_are_decimal_alone_are_read():
    (row,) = read_table("a;b;c\n1.500;2.5;0.125\n", ["a", "b", "c"]).rows
    assert [row.number(name) for name in "abc"] == [1.5, 2.5, 0.125]
    (row,) = read_table("a;b\n1,500;0.125\n", ["a", "b"]).rows
    assert [row.number(name) for name in "ab"] == [1.5, 0.125]
