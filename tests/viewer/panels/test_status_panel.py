"""What the foot of the left column says."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from one_element import OneElement

from modeviz.analysis.exact_check import Check, ClassicError
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.viewer.panels.status import StatusPanel, _rounded
from modeviz.viewer.session.findings import Findings


@pytest.fixture(scope="module")
def now():
    return solve(prepare(mounted_cabin(), np.array([1.0, 2.0])), {}, Conditions("flat", 20.0))


def content(now, **changes):
    """What the panel draws of an answer."""
    page = OneElement()
    values = {"check": None, "problem": "", "classic_error": None, "seconds": 0.0042, "missing": ""}
    values |= changes
    state = SimpleNamespace(classic=values["classic_error"] is not None, against="Original")
    findings = Findings(now, check=values.pop("check"), problem=values.pop("problem"))
    StatusPanel(page).show(SimpleNamespace(now=now, state=state, findings=findings, **values))
    return page.content


def shown(now, **changes):
    """The text of the panel, without its markup."""
    return re.sub("<[^>]*>", " ", content(now, **changes))


def test_the_preparation_shows_how_far_it_is():
    page = OneElement()
    StatusPanel(page).show_progress(0.43)
    assert "Preparing" in page.content
    assert "43 %" in page.content


def test_an_answer_has_its_time_and_its_health(now):
    text = shown(now)
    assert "4.2 ms" in text
    assert re.search(r"12 modes below 40 Hz, none missed, each within 0\.001 Hz", text)
    assert "exact solve follows" in text


def test_a_missed_mode_is_said(now):
    band = replace(now.band, trust=replace(now.trust, n_missed=2))
    assert "2 not found" in shown(replace(now, band=band))


@pytest.mark.parametrize(
    ("check", "words"),
    [
        (Check(2e-8, 5e-3, 400, 400), "within 0.5 % of exact"),
        (Check(2e-8, 0.0, 20, 400), "within 0.001 % of exact, 20 of 400 lines so far"),
        (Check(2e-8, 0.0, 0, 400, "too stiff"), "not checked: too stiff"),
    ],
)
def test_the_largest_difference_from_the_exact_solve_is_shown(now, check, words):
    assert words in shown(now, check=check)


def test_a_large_difference_is_no_good_sign(now):
    for error, dot in ((1e-7, "--mv-good"), (1e-2, "--mv-bad")):
        assert dot in content(now, check=Check(error, 0.0, 400, 400))


def test_what_could_not_be_found_out_is_said(now):
    assert "not checked: too stiff" in shown(now, problem="too stiff")


def test_it_says_which_set_stands_for_one_without_an_answer(now):
    assert "Rigid has no answer, see Variants: compared with Original" in shown(now, missing="Rigid")


def test_the_classic_methods_error_is_shown_on_request(now):
    f = now.modes.frequency_hz[11]
    text = shown(now, classic_error=ClassicError(11, 1.05 * f, 0.05))
    assert "up to 5 % off" in text
    assert f"{1.05 * f:.2f} instead of {f:.2f} Hz" in text


@pytest.mark.parametrize(
    ("value", "text"), [(0.0, "0.001"), (3.4e-7, "0.001"), (0.0123, "0.01"), (12.34, "12")]
)
def test_small_numbers_are_written_out(value, text):
    assert _rounded(value) == text
