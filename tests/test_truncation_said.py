"""What is said of truncation, held against the full models of bodies of many kinds."""

import numpy as np
import pytest

from benchmarks.truncation import cases


@pytest.fixture(scope="module")
def found():
    return list(cases(seed=11, every=40))


@pytest.mark.slow
def test_what_is_said_of_truncation_holds(found):
    """A figure within a factor of two, ends that hold the truth, and what it is at least."""
    assert len(found) > 80
    known = [case for case in found if case.gap.within < 10]
    assert len(known) > 5
    for within in (2, 4):
        off = np.array([case.off for case in known if case.gap.within == within])
        assert np.mean(off <= within) > 0.9
    assert np.mean([case.true >= case.gap.at_least for case in found]) > 0.96


@pytest.mark.slow
def test_most_of_it_is_right_within_a_factor_of_four(found):
    """Of three in five it is when all places are estimated alike, by Σ φ²/ω²."""
    assert np.mean([case.off <= 4 for case in found]) > 0.8
