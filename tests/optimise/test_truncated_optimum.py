"""Rates that are stiff beside truncated bodies are found with a word on their frequencies."""

from datetime import date
from html import unescape

import numpy as np
import pytest
from html_documents import Document
from two_sheets import joined, sheets

import modeviz as mv
from modeviz.analysis.preparation import prepare
from modeviz.dynamics.truncation_gap import truncation_gap
from modeviz.files import write_vehicle
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html import report
from modeviz.report.truncation import truncation_doubts
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.loads import Force, ResponsePoint
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DesignGroup, Performance, Problem
from modeviz.vehicle.vehicle import Vehicle

SOFT = MountRates(1e3, 5e2, 5e2)
STIFF = MountRates(1e5, 5e4, 5e4), MountRates(4e5, 2e5, 2e5)
"""Bounds of the search: beside these rates the sheets are soft."""


def coupled_sheets(with_residuals: bool) -> Vehicle:
    """Two sheets on soft mounts, for which stiff ones are sought."""
    floor, roof = (sheet.body(24, with_residuals) for sheet in sheets())
    springs = joined(floor, roof, np.zeros((4, 3))).connections
    mounts = tuple(Mount(s.name, "M", s.bodies, s.points) for s in springs)
    place = roof.attachments[0].position
    return Vehicle(
        "sheets",
        (floor, roof),
        (),
        mount_groups=(MountGroup("M", "M", SOFT, 0.1, (SOFT, STIFF[1]), mounts),),
        response_points=(ResponsePoint("roof", "roof", place),),
        forces=(Force("shaker", "roof", place, np.array([0.0, 0.0, 1.0]), 1.0),),
        problems=(
            Problem(
                "stiff",
                groups=(DesignGroup("M", bounds=STIFF),),
                performance=(Performance(np.array([1.0]), wheel_loads=("shaker",)),),
            ),
        ),
    )


@pytest.fixture(scope="module")
def truncated() -> Vehicle:
    return coupled_sheets(with_residuals=False)


@pytest.fixture(scope="module")
def study(truncated) -> mv.Study:
    return mv.Study(truncated)


@pytest.fixture(scope="module")
def optimum(study):
    return study.optimise("stiff", starts=1)


@pytest.fixture(scope="module")
def doubts(truncated, optimum) -> list[str]:
    """What `check` says of a folder with the rates that were found."""
    return list(truncation_doubts(truncated.with_rates(optimum.rates)))


def test_it_makes_the_mounts_stiffer_than_the_bodies_bear(truncated, optimum, doubts):
    gap = truncation_gap(truncated.with_rates(optimum.rates))
    assert optimum.truncation.change == pytest.approx(gap.change, rel=1e-6)
    assert gap.change > 3 * truncation_gap(truncated).change
    assert "connections are stiffer than a tenth of it" in doubts[0]


def test_its_tables_have_the_doubts_of_check_at_the_rates_that_were_found(optimum, doubts):
    table, page = optimum.table(), unescape(optimum._repr_html_())
    for doubt in doubts:
        assert f"at these rates {doubt}" in table
        assert f"at these rates {doubt}" in page
    assert "solved from scratch, the model as given differs in its objective by" in table
    assert "full model" not in table + page


def test_json_has_by_how_much_frequencies_are_too_high(printed_json, tmp_path, truncated, optimum):
    write_vehicle(truncated, tmp_path / "v")
    record = printed_json("optimise", str(tmp_path / "v"), "--starts", "1")
    assert record["truncation"]["bodies"] == ["floor", "roof"]
    assert record["truncation"]["change"] == pytest.approx(optimum.truncation.change, rel=1e-3)


def test_a_report_on_the_rates_that_were_found_has_the_doubts_of_check(truncated, optimum, doubts):
    sets = RateSet("original", {}), RateSet("found", optimum.rates)
    words = Document(report(compare(prepare(truncated), *sets, None), date(2026, 11, 29))).words
    for doubt in doubts:
        assert f"With the rates of found, {doubt}" in words


def test_with_residual_vectors_there_is_nothing_to_say():
    whole = mv.Study(coupled_sheets(with_residuals=True)).optimise("stiff", starts=1)
    assert whole.truncation is None
    assert "at these rates" not in whole.table()
    assert whole.to_dict()["truncation"] is None
