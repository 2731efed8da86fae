import re
from base64 import b64decode
from dataclasses import replace
from datetime import date

import numpy as np
import pytest
from cabin_problem import PROBLEM
from html_documents import Document, value
from mounted_cabin import mounted_cabin

from modeviz.analysis.exact_check import Check
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions
from modeviz.analysis.wheel_peaks import wheel_peak_lines
from modeviz.dynamics.tracking import Track
from modeviz.optimise.goals import prepare_goal
from modeviz.report.charts import BOTTOM, LEFT, RIGHT, TOP
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html import Picture, report
from modeviz.ride.psd import power_decibels
from modeviz.text.axes import USUAL_SHOWN_HZ, decibel_axis
from modeviz.vehicle.loads import WheelLoad
from modeviz.vehicle.mount_rates import DIRECTIONS, MountRates
from modeviz.vehicle.problem import DesignGroup, Problem

TODAY = date(2026, 11, 22)
SOFT = RateSet("soft", {"A": MountRates(2e5, 1e5, 4e5)})
ORIGINAL = RateSet("original", {})
FLAT = Conditions("flat", 25.0)


@pytest.fixture(scope="module")
def comparison():
    return compare(prepare(mounted_cabin()), ORIGINAL, SOFT, FLAT)


@pytest.fixture(scope="module")
def text(comparison):
    return report(comparison, TODAY)


@pytest.fixture(scope="module")
def document(text):
    return Document(text)


def test_it_says_what_is_compared_on_which_road_and_when(document):
    assert document.headings[0] == "cabin: soft against original"
    for words in ("Flat road", "90 km/h", "2026-11-22", "modeviz 0."):
        assert words in document.words


def test_rates_are_in_newtons_per_millimetre_with_their_change(document):
    header, *rows = document.tables["Mount rates"]
    assert header == ["Mount", "original, N/mm", "soft, N/mm", "Change"]
    assert rows[:4] == [
        ["A front"],
        ["vertical", "800", "200", "−75.0 %"],
        ["lateral", "300", "100", "−66.7 %"],
        ["fore-aft", "400", "400", "0.0 %"],
    ]
    assert rows[4] == ["B rear"]


def test_the_reference_of_the_usual_problem_stands_beside_both_sets():
    problem = Problem("comfort", (DesignGroup("A"),), goal="change", reference="soft")
    vehicle = replace(mounted_cabin(), problems=(problem,))
    stiff = RateSet("stiff", {"A": MountRates(1.6e6, 3e5, 4e5)})
    found = compare(prepare(vehicle), ORIGINAL, stiff, None)
    header, *rows = Document(report(found, TODAY)).tables["Mount rates"]
    assert header[1:] == ["original, N/mm", "stiff, N/mm", "Change", "soft, N/mm", "Change"]
    assert rows[1] == ["vertical", "800", "1600", "+100.0 %", "200", "−75.0 %"]
    for names in (("original", "soft"), ("soft", "soft")):
        both = compare(prepare(vehicle), *(RateSet(name, {}) for name in names), None)
        header, *_ = Document(report(both, TODAY)).tables["Mount rates"]
        assert header[1:] == [f"{names[0]}, N/mm", f"{names[1]}, N/mm", "Change"]


@pytest.mark.parametrize("is_normalised", [True, False])
def test_the_objective_of_the_usual_problem_is_told_of_all_sets(is_normalised):
    vehicle = replace(mounted_cabin(), problems=(replace(PROBLEM, is_normalised=is_normalised),))
    stiff = RateSet("stiff", {"A": MountRates(1.6e6, 3e5, 4e5)})
    document = Document(report(compare(prepare(vehicle), ORIGINAL, stiff, FLAT), TODAY))
    header, row = document.tables["Objective"]
    assert header == ["", "original", "stiff", "Change", "soft", "Change"]
    goal = prepare_goal(vehicle, vehicle.problems[0], vehicle.rates, FLAT.speed)
    parts = [goal.value(r) / goal.value({}) for r in (stiff.rates, vehicle.rate_sets["soft"])]
    assert row[:2] == ["Cabin", "1"]
    assert [float(row[2]), float(row[4])] == pytest.approx(parts, rel=1e-3)
    assert [value(row[3]), value(row[5])] == pytest.approx(
        [100 * (part - 1) for part in parts], abs=0.051
    )
    sum_of = "each load case relative to the original" if is_normalised else "plain sum"
    assert f"squared accelerations, {sum_of}, as parts of the original’s" in document.words


def test_it_says_which_sets_the_usual_problem_could_not_find():
    vehicle = replace(mounted_cabin(), problems=(PROBLEM,))
    leaning = RateSet("leaning", {"B": MountRates(8e5, 2e5, 4e5, loss_factor=0.3)})
    words = Document(report(compare(prepare(vehicle), ORIGINAL, leaning, FLAT), TODAY)).words
    assert "search from the original rates keeps B lateral 0.375 and fore-aft 0.5 of vertical." in words
    assert (
        "“leaning” lies outside of what is searched: B lateral is 0.25 of vertical, kept at 0.375; "
        "B loss factor is 0.3, kept at 0.15."
    ) in words
    assert "“original” lies outside" not in words


def test_loss_factors_are_told_where_they_changed():
    damped = RateSet("damped", {"B": MountRates(8e5, 3e5, 4e5, loss_factor=0.3)})
    found = compare(prepare(mounted_cabin()), ORIGINAL, damped, FLAT)
    rows = Document(report(found, TODAY)).tables["Mount rates"]
    assert [row for row in rows if row[0] == "loss factor"] == [
        ["loss factor", "0.15", "0.3", "+100.0 %"]
    ]
    assert rows[-1][0] == "loss factor"


def test_modes_of_one_name_stand_side_by_side(comparison, document):
    _, _, *rows = document.tables["Natural frequencies below 25 Hz"]
    base, now = comparison.base, comparison.now
    named = {row[0].lower(): row for row in rows}
    both = 0
    for i, name in enumerate(base.names):
        f, mode = base.modes.frequency_hz[i], now.mode_index(name.name)
        if f < 25 and mode is None:
            assert named[name.name][2:5] == ["–", "–", "–"]
        elif f < 25:
            both += 1
            f_now, damping = now.modes.frequency_hz[mode], 100 * now.modes.damping_ratio[mode]
            cells = [value(named[name.name][column]) for column in (1, 2, 3, 6)]
            assert cells == pytest.approx([f, f_now, f_now - f, damping], abs=0.051)
            assert value(named[name.name][4]) == pytest.approx(100 * (f_now / f - 1), abs=0.051)
    assert both > 5
    before = [value(row[1] if row[1] != "–" else row[2]) for row in rows]
    assert before == sorted(before)


def test_peaks_name_their_largest_contributors(comparison, document):
    (table,) = (rows for heading, rows in document.tables.items() if heading.startswith("Modes in"))
    start = table.index(["Lateral, soft"]) + 1
    results = comparison.now
    for peak, row in zip(results.peaks(0, "lateral", 2), table[start:], strict=False):
        first, second = peak.contributors
        assert [value(cell) for cell in (row[0], row[2], row[4], row[6])] == pytest.approx(
            [
                peak.frequency_hz,
                results.modes.frequency_hz[first.mode],
                results.modes.frequency_hz[second.mode],
                second.ratio,
            ],
            abs=0.0051,
        )
        assert [row[3], row[5]] == [results.names[c.mode].spoken for c in peak.contributors]


def test_wheel_loads_have_means_from_11_to_16_hz(comparison, document):
    row = document.tables["Seat"][-1]
    base, now = (1000 * w.mean((11.0, 16.0))[0, 0] for w in comparison.wheels)
    expected = [mean[axis] for axis in (2, 1, 0) for mean in (base, now)]
    assert [value(row[i]) for i in (1, 2, 5, 6, 9, 10)] == pytest.approx(expected, abs=0.0051)


def test_changes_of_means_are_relative_to_themselves_and_to_the_largest(comparison, document):
    """The paper's Tables 5 and 6 have the second; the first is what hides in them."""
    groups, header, row = document.tables["Seat"]
    assert groups == ["", "Vertical", "Lateral", "Fore-aft"]
    assert header[1:5] == ["original", "soft", "Change", "of largest"]
    base, now = (1000 * w.mean((11.0, 16.0))[0, 0] for w in comparison.wheels)
    for axis, own, common in zip((2, 1, 0), (3, 7, 11), (4, 8, 12), strict=True):
        change = now[axis] - base[axis]
        assert value(row[own]) == pytest.approx(100 * change / base[axis], abs=0.051)
        assert value(row[common]) == pytest.approx(100 * change / base.max(), abs=0.051)
    where = ("fore-aft", "lateral", "vertical")[int(base.argmax())]
    largest = f"the largest mean of original, {base.max():.2f} (seat, {where}, front left radial force)"
    assert largest in document.words


def lines(text, number):
    """Width and height of the chart of that number, and its curves, (n_freqs, 2)."""
    svg = re.findall(r"<svg xmlns.*?</figure>", text)[number]
    _, _, width, height = map(float, re.search(r'viewBox="([^"]*)"', svg)[1].split())
    curves = re.findall(r'<polyline points="([^"]*)"', svg)
    points = [np.array([p.split(",") for p in curve.split()], float) for curve in curves]
    return width - LEFT - RIGHT, height - TOP - BOTTOM, points


def assert_drawn(text, number, f, levels):
    """The curves of a chart are these levels, as far as they are within it."""
    width, height, curves = lines(text, number)
    inside = [(own >= USUAL_SHOWN_HZ[0]) & (own <= USUAL_SHOWN_HZ[1]) for own in f]
    seen = [level[its] for level, its in zip(levels, inside, strict=True)]
    axis = decibel_axis("", seen)
    for points, own, level, its in zip(curves, f, seen, inside, strict=True):
        x, y = points[its].T
        shown = level > axis.low
        hertz = USUAL_SHOWN_HZ[0] + x / width * (USUAL_SHOWN_HZ[1] - USUAL_SHOWN_HZ[0])
        decibels = axis.high - y / height * (axis.high - axis.low)
        np.testing.assert_allclose(hertz, own[its], atol=0.06 * 24 / width)
        np.testing.assert_allclose(decibels[shown], level[shown], atol=0.06 * 60 / 190)


@pytest.mark.parametrize(("number", "direction"), list(enumerate(DIRECTIONS)))
def test_curves_are_the_spectra_of_both_sets(comparison, text, number, direction):
    levels = [power_decibels(r.response(0, direction)) for r in comparison.rides]
    assert_drawn(text, number, [r.frequency_hz for r in comparison.rides], levels)


@pytest.mark.parametrize(("number", "axis"), [(3, 1), (4, 2)])
def test_curves_are_the_harmonic_responses_of_both_sets(comparison, text, number, axis):
    levels = [20 * np.log10(w.acceleration_g[:, 0, 0, axis]) for w in comparison.wheels]
    assert_drawn(text, number, [w.frequency_hz for w in comparison.wheels], levels)


def test_the_load_that_is_drawn_is_the_rear_radial_force_on_the_drivers_side():
    vehicle = mounted_cabin()
    loads = [
        WheelLoad(f"{kind} {tyre.name}", kind, tyre.name, 10.0)
        for tyre in vehicle.tyres
        for kind in ("unbalance", "radial force")
    ]
    for order in (loads, loads[::-1]):
        vehicle = replace(vehicle, wheel_loads=tuple(order))
        text = report(compare(prepare(vehicle), ORIGINAL, SOFT, None), TODAY)
        for direction in ("Lateral", "Vertical"):
            assert f"{direction} acceleration at seat under radial force tyre 2.5 -0.7;" in text


def test_curves_are_full_lines_whose_peaks_are_marked(comparison, text):
    assert "stroke-dasharray" not in text
    f = comparison.base.frequency_hz
    charts = re.findall(r"<svg xmlns.*?</figure>", text)
    for chart, direction in zip(charts[:3], DIRECTIONS, strict=True):
        found = [line for r in comparison.rides for line in r.peak_lines(0, direction)]
        shown = [line for line in found if USUAL_SHOWN_HZ[0] <= f[line] <= USUAL_SHOWN_HZ[1]]
        assert 1 <= chart.count("<circle") <= len(shown)
    for chart, direction in zip(charts[3:], ("lateral", "vertical"), strict=True):
        found = [line for w in comparison.wheels for line in wheel_peak_lines(w, 0, 0, direction)]
        assert chart.count("<circle") == len(
            [n for n in found if USUAL_SHOWN_HZ[0] <= f[n] <= USUAL_SHOWN_HZ[1]]
        )


def test_it_says_how_exact_it_is(comparison, document):
    assert document.words.count("none missed") == 2
    checked = report(comparison, TODAY, check=Check(2.3e-9, 4.1e-11, 10, 400))
    assert "differ by 2 × 10⁻⁹ at most" in checked
    assert "spectra by 4 × 10⁻¹¹ of the largest of each, at 10 of 400 frequencies" in checked
    wrong = report(comparison, TODAY, check=Check(np.inf, 0.0, 0, 400))
    assert "another number of modes" in wrong
    halted = report(comparison, TODAY, check=Check(0.0, 0.0, 0, 400, "it is <singular>"))
    assert "it is &lt;singular&gt;" in halted


def test_nothing_has_to_be_loaded_or_run(text, document):
    assert not document.tags & {"script", "link", "iframe", "object"}
    assert document.addresses == []
    assert not re.search(r"url\(|@import|https?://(?!www\.w3\.org/2000/svg)", text)


def test_pictures_are_in_the_file_with_their_captions(comparison):
    document = Document(report(comparison, TODAY, [Picture('cab "yaw" <1>', b"\x89PNG data")]))
    (address,) = document.addresses
    kind, data = address.split(",")
    assert kind == "data:image/png;base64"
    assert b64decode(data) == b"\x89PNG data"
    assert 'cab "yaw" <1>' in document.words


def named_badly():
    """Every name of the cabin that a user gives brings markup."""
    vehicle, bad = mounted_cabin(), "<script>&\"'"
    groups = tuple(
        replace(g, name=g.name + bad, label=bad, mounts=tuple(replace(m, group="") for m in g.mounts))
        for g in vehicle.mount_groups
    )
    return replace(
        vehicle,
        name=f"cabin {bad}",
        bodies=tuple(replace(b, label=f"{b.label}{bad}") for b in vehicle.bodies),
        mount_groups=groups,
        response_points=tuple(replace(p, name=f"seat {bad}") for p in vehicle.response_points),
        roads=tuple(replace(r, name=f"{r.name}{bad}", label=f"{r.label}{bad}") for r in vehicle.roads),
        wheel_loads=tuple(replace(w, name=f"{w.name}{bad}") for w in vehicle.wheel_loads),
        rate_sets={},
    )


def test_no_name_brings_markup_into_it():
    bad = "<script>&\"'"
    vehicle = named_badly()
    rates = {vehicle.mount_groups[0].name: MountRates(2e5, 1e5, 4e5)}
    sets = RateSet(f"first{bad}", {}), RateSet(f"second{bad}", rates)
    found = compare(prepare(vehicle), *sets, Conditions(f"flat{bad}", 20.0))
    document = Document(report(found, TODAY, [Picture(f"shape{bad}", b"")]))
    assert "script" not in document.tags
    for name in (
        "cabin ",
        "A",
        "seat ",
        "flat",
        "Flat road",
        "front left radial force",
        "first",
        "shape",
    ):
        assert f"{name}{bad}".lower() in document.words.lower()


ALL = [
    "Mount rates",
    "Natural frequencies below 25 Hz",
    "Acceleration at seat",
    "Ride",
    "Modes in the peaks at seat",
    "Unbalance and tyre force variation",
    "How exact this is",
]
ON_A_ROAD = {"Acceleration at seat", "Ride", "Modes in the peaks at seat"}


@pytest.mark.parametrize(
    ("without", "missing"),
    [
        ({"wheel_loads": ()}, {"Unbalance and tyre force variation"}),
        ({"roads": ()}, ON_A_ROAD),
        ({"response_points": ()}, ON_A_ROAD | {"Unbalance and tyre force variation"}),
        ({"mount_groups": (), "rate_sets": {}}, {"Mount rates"}),
    ],
)
def test_what_a_vehicle_does_not_have_is_left_out(without, missing):
    vehicle = replace(mounted_cabin(), **without)
    road = FLAT if vehicle.roads and vehicle.response_points else None
    now = SOFT if vehicle.mount_groups else ORIGINAL
    document = Document(report(compare(prepare(vehicle), ORIGINAL, now, road), TODAY))
    assert [h for h in document.headings if h in ALL] == [h for h in ALL if h not in missing]


@pytest.mark.parametrize("rounding", [0.0, 1e-12])
def test_the_same_set_twice_changes_nothing(rounding):
    """Nor does what differs by no more than other kernels round."""
    softer = {"A": MountRates(8e5 * (1 - rounding), 3e5, 4e5)}
    same = compare(prepare(mounted_cabin()), ORIGINAL, RateSet("same", softer), FLAT)
    text = report(same, TODAY)
    assert 'class="good"' not in text
    assert 'class="bad"' not in text
    assert all(row[-1] == "" for row in Document(text).tables["Natural frequencies below 25 Hz"][2:])


def went_to(comparison, shares):
    """What the last column says of the cab yaw, if so much of its shape is in modes of these names."""
    base, now = comparison.base, comparison.now
    yaw, track = base.mode_index("cab yaw"), comparison.track
    row = np.zeros(len(now.names))
    row[[now.mode_index(name) for name in shares]] = list(shares.values())
    found, index = track.shares.copy(), track.index.copy()
    found[yaw] = row
    index[yaw] = row.argmax() if row.any() else -1
    document = Document(report(replace(comparison, track=Track(found, index)), TODAY))
    table = document.tables["Natural frequencies below 25 Hz"]
    (said,) = [cells[-1] for cells in table[2:] if cells[0] == "Cab yaw"]
    return said


def test_where_a_shape_went_is_said_if_that_is_not_clear_from_the_name(comparison):
    now = comparison.now
    yaw, bounce = (
        f"{now.names[i].spoken}, {now.modes.frequency_hz[i]:.2f} Hz (MAC {{:.2f}})"
        for i in map(now.mode_index, ("cab yaw", "cab bounce"))
    )
    assert went_to(comparison, {"cab yaw": 0.9}) == ""
    assert went_to(comparison, {"cab bounce": 0.9}) == bounce.format(0.9)
    shared = went_to(comparison, {"cab yaw": 0.5, "cab bounce": 0.44})
    assert shared == f"{yaw.format(0.5)}; {bounce.format(0.44)}"
    assert went_to(comparison, {"cab yaw": 0.6, "cab bounce": 0.25}) == yaw.format(0.6)
    assert went_to(comparison, {}) == "above the band"
