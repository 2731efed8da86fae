"""What `Study.static` gives: cases by name, sag, travel, a table and a piece of a notebook."""

import re

import numpy as np
import pytest
from engine_on_mounts import limited_engine

import modeviz as mv
from modeviz.errors import SolveError, VehicleError


@pytest.fixture(scope="module")
def study():
    return mv.Study(limited_engine())


def test_cases_iterate_and_are_found_by_name(study):
    static = study.static()
    assert [case.name for case in static] == ["standing", "bump 3 g"]
    assert len(static) == 2
    # ../shared/cases/powertrain/README.md, but for the stop, which holds along x alone
    assert static.sag("engine")[2] == pytest.approx(-1.23843e-3, abs=1e-7)
    np.testing.assert_allclose(static.sag("engine", "bump 3 g"), 3 * static.sag("engine"))
    assert static["standing"].connections["M3"].force[2] == pytest.approx(508.13, abs=0.01)
    with pytest.raises(SolveError, match="load case 'push': nothing holds 'loose'"):
        static["push"]
    with pytest.raises(VehicleError, match="unknown body 'engin'"):
        static.sag("engin")


def test_travel_says_what_is_left(study):
    failed = [t for t in study.static().travel("standing") if not t.passed]
    assert [(t.mount, t.direction) for t in failed] == [("M3", "vertical")]
    assert failed[0].margin == pytest.approx(-0.588e-3, abs=1e-6)


def test_rates_that_are_set_change_it(study):
    before = study.static().sag("engine")[2]
    study.rates["M3.vertical"] = "130 N/mm"
    assert study.static().sag("engine")[2] < before < 0
    study.rates.reset()
    assert study.static().sag("engine")[2] == before


def test_a_notebook_shows_every_case_and_what_has_no_answer(study):
    html = study.static()._repr_html_()
    text = re.sub(r"<[^>]*>", " ", html)
    for words in ("standing", "bump 3 g", "M3 vertical", "failed", "push: no answer"):
        assert words in text
