"""`modeviz report` says what the other commands say."""

from dataclasses import replace

import pytest
from html_documents import Document, value
from mounted_cabin import mounted_cabin

from modeviz.cli import main, options
from modeviz.files import write_vehicle

CHANGED = ["--rates", "soft", "--set", "B.lateral=131 N/mm"]
ROAD = ["--road", "rough", "--speed", "90 km/h"]


@pytest.fixture(scope="module")
def document(folder, tmp_path_factory):
    output = tmp_path_factory.mktemp("reports") / "report.html"
    assert main(["report", "--no-pictures", folder, *CHANGED, *ROAD, "--output", str(output)]) == 0
    return Document(output.read_text("utf-8"))


def test_it_names_both_sets(document):
    assert document.headings[0] == "cabin: soft, changed against original"


def test_its_modes_and_rates_are_those_of_modeviz_modes(printed_json, document, folder):
    record = printed_json("modes", folder, *CHANGED)
    rates = iter(row for row in document.tables["Mount rates"][1:] if len(row) > 1)
    for group in record["rates"].values():
        for direction in ("vertical", "lateral", "fore_aft"):
            assert value(next(rates)[2]) == group[direction]
    rows = document.tables["Natural frequencies below 25 Hz"][2:]
    found = [(value(row[2]), value(row[6]), row[0].lower()) for row in rows if row[2] != "–"]
    modes = [mode for mode in record["modes"] if mode["frequency_hz"] < 25]
    for (f, damping, name), mode in zip(sorted(found), modes, strict=False):
        assert name == mode["name"]
        assert f == pytest.approx(mode["frequency_hz"], abs=0.0051)
        assert damping == pytest.approx(100 * mode["damping_ratio"], abs=0.051)
    assert len(modes) > 5


def test_shapes_went_where_modeviz_modes_says(printed_json, document, folder):
    record = printed_json("modes", folder, *CHANGED)
    rows = {row[0].lower(): row[-1] for row in document.tables["Natural frequencies below 25 Hz"][2:]}
    parted = 0
    for origin in record["original"]:
        mode = record["modes"][origin["now"] - 1]
        if mode["name"] == origin["name"] and not origin["weak"]:
            assert rows[origin["name"]] == ""
        else:
            parted += 1
            for words in (mode["name"], f"{mode['frequency_hz']:.2f} Hz", f"(MAC {origin['mac']:.2f})"):
                assert words in rows[origin["name"]]
    assert parted


def test_its_levels_and_rating_are_those_of_modeviz_psd(printed_json, document, folder):
    record = printed_json("psd", folder, *CHANGED, *ROAD)
    (row,) = document.tables["RMS acceleration, 0.1 to 40 Hz, g"][2:]
    rms = {r["direction"]: r["rms_g"] for r in record["responses"]}
    for column, direction in ((2, "vertical"), (5, "lateral"), (8, "fore-aft")):
        assert value(row[column]) == pytest.approx(rms[direction], abs=0.000051)
    rating = record["rating"]
    expected = [
        rating["combined_g"],
        rating["mean_personal_rating"],
        *rating["weighted_rms"],
        rating["weighted_total"],
    ]
    rows = document.tables["Rating at seat"][1:]
    assert [value(row[3]) for row in rows] == pytest.approx(expected, abs=0.0051)


def test_its_wheel_responses_are_those_of_modeviz_wheels(printed_json, document, folder):
    record = printed_json("wheels", folder, *CHANGED)
    inside = [11 <= f <= 16 for f in record["frequency_hz"]]
    by_direction = {r["direction"]: r["acceleration_g"] for r in record["loads"][0]["responses"]}
    row = document.tables["Seat"][-1]
    for column, direction in ((2, "vertical"), (6, "lateral"), (10, "fore-aft")):
        band = [a for a, is_in in zip(by_direction[direction], inside, strict=True) if is_in]
        assert value(row[column]) == pytest.approx(1000 * sum(band) / len(band), abs=0.0051)


def test_it_can_be_held_against_another_set(folder, tmp_path):
    output = tmp_path / "out.html"
    assert main(["report", "--no-pictures", folder, "--against", "soft", "--output", str(output)]) == 0
    document = Document(output.read_text("utf-8"))
    assert document.headings[0] == "cabin: original against soft"
    assert document.tables["Mount rates"][2] == ["vertical", "200", "800", "+300.0 %"]


def test_mounts_that_are_moved_are_held_against_the_vehicle_as_it_is(printed_json, folder, tmp_path):
    output, place = tmp_path / "out.html", ["--place", "A=200,0,0 mm"]
    assert main(["report", "--no-pictures", folder, *place, "--output", str(output)]) == 0
    document = Document(output.read_text("utf-8"))
    assert document.headings[0] == "cabin: original, changed against original"
    rows = document.tables["Natural frequencies below 25 Hz"][2:]
    for column, arguments in ((1, []), (2, place)):
        modes = printed_json("modes", folder, *arguments)["modes"]
        expected = [mode["frequency_hz"] for mode in modes if mode["frequency_hz"] < 25]
        found = sorted(value(row[column]) for row in rows if row[column] != "–")
        assert found == pytest.approx(expected, abs=0.0051)


def test_a_vehicle_without_roads_and_loads_has_a_report_of_its_modes(folder, tmp_path):
    bare = replace(mounted_cabin(), roads=(), wheel_loads=(), response_points=())
    write_vehicle(bare, tmp_path / "bare")
    output = tmp_path / "out.html"
    assert main(["report", "--no-pictures", str(tmp_path / "bare"), "--output", str(output)]) == 0
    tables = Document(output.read_text("utf-8")).tables
    assert [*tables][:3] == ["Mount rates", "Natural frequencies below 25 Hz", "Bodies on their mounts"]
    assert not {"Running engines", "Unbalance and tyre force variation"} & tables.keys()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--output", "{tmp}"], "expected a file or a new name"),
        (["--output", "{tmp}/no/such/report.html"], "cannot be written (there is no folder"),
        (["--against", "hard", "--output", "{tmp}/out.html"], "there are original, soft, or give"),
        (["--road", "moon", "--output", "{tmp}/out.html"], "unknown random load 'moon'"),
    ],
)
def test_what_is_wrong_is_said_before_anything_is_solved(
    capsys, monkeypatch, folder, tmp_path, arguments, message
):
    monkeypatch.setattr(options, "prepare", lambda *_, **__: pytest.fail("it was prepared"))
    assert main(["report", "--no-pictures", folder, *(a.format(tmp=tmp_path) for a in arguments)]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_road_is_not_passed_over_where_there_is_none(capsys, tmp_path):
    write_vehicle(replace(mounted_cabin(), roads=()), tmp_path / "bare")
    arguments = ["report", str(tmp_path / "bare"), "--road", "flat", "--output", str(tmp_path / "a")]
    assert main(arguments) == 2
    assert "unknown random load 'flat': there are ISO A" in capsys.readouterr().err
