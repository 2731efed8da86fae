"""What the page says of a front."""

from dataclasses import replace

import numpy as np
import pytest

from modeviz.dynamics.truncation_gap import TruncationGap
from modeviz.optimise.trade_off import ParetoPoint
from modeviz.optimise.verification import Verification
from modeviz.viewer.panels.trade_off import where
from modeviz.viewer.tasks.background_task import Job


def design(difference=None, impossible="", gap=None):
    verification = Verification(1.0, difference, np.zeros(0), True, impossible, gap)
    found = ParetoPoint(np.zeros(1), {}, (1.0, 1.0))
    return found if difference is None else replace(found, verification=verification)


def test_a_front_is_held_against_the_full_model_design_after_design():
    job = Job("what was asked", done=1.0, found=(design(), design()))
    assert "Searching" in where(job)
    checking = where(replace(job, found=(design(1e-14), design())))
    assert "Checking" in checking
    assert "from scratch" not in checking


def test_the_largest_difference_is_told():
    said = where(Job("what was asked", "ended", found=(design(1e-14), design(1e-9))))
    assert "Solved from scratch, the model as given has the same goals within 0.001 %." in said
    assert "bad" not in said
    said = where(Job("what was asked", "ended", found=(design(1e-14), design(3e-4), design(1e-9))))
    assert "within 0.03 %." in said
    assert "bad" in said


def test_the_design_whose_frequencies_are_most_too_high_is_told():
    gaps = [TruncationGap(("cab",), change, 9.5, 30.0, 2.0) for change in (0.02, 0.1, 0.05)]
    said = where(Job("what was asked", "ended", found=tuple(design(1e-14, gap=g) for g in gaps)))
    assert "At the rates of design 2 frequencies below 30 Hz are too high by up to about 10 %" in said
    assert "as there are no or too few residual vectors of &#x27;cab&#x27;; ask the solver" in said
    small = design(1e-14, gap=replace(gaps[0], change=1e-3))
    assert "too high" not in where(Job("what was asked", "ended", found=(small, design(1e-14))))


@pytest.mark.parametrize(
    ("designs", "sentence"),
    [
        ((design(1e-9), design(np.nan, "it is singular")), "Not checked: it is singular"),
        ((design(1e-9), design()), "Not solved from scratch."),
    ],
)
def test_what_could_not_be_checked_is_told(designs, sentence):
    assert sentence in where(Job("what was asked", "cancelled", found=designs))
