import numpy as np
import pytest
from scattered_cabin import cabin_parts, cabin_receptances, drawn_and_sampled, worst_error
from small_systems import resonant_rate, two_masses

from modeviz.dynamics.galerkin import reduced
from modeviz.dynamics.reanalysis import prepare_receptances
from modeviz.errors import SolveError

FREQUENCY_HZ = np.arange(1, 41) * 1.0


@pytest.fixture(scope="module")
def receptances():
    return cabin_receptances(FREQUENCY_HZ)


@pytest.fixture(scope="module")
def parts():
    return cabin_parts()


@pytest.fixture(scope="module")
def few(receptances, parts):
    return reduced(receptances, drawn_and_sampled(parts, 64))


def test_few_stretches_are_enough(few):
    assert max(line.basis.shape[1] for line in few.lines) < 12


def test_parts_that_were_not_learned_from_are_answered(few, receptances, parts):
    assert worst_error(few, receptances, parts.stiffness(parts.samples(40, 1))) < 1e-3


def test_parts_as_drawn_are_exact(few, receptances, parts):
    drawn = parts.stiffness(np.zeros((1, 8)))
    np.testing.assert_allclose(few.responses(drawn), receptances.responses(drawn), rtol=1e-9)


def test_all_stretches_are_exact(receptances, parts, monkeypatch):
    """With nothing left out it is structural modification, only in other coordinates."""
    monkeypatch.setattr("modeviz.dynamics.galerkin.TOLERANCE", 0.0)
    stiffness = parts.stiffness(np.vstack([np.zeros(8), parts.samples(64, 0)]))
    every = reduced(receptances, stiffness)
    other = parts.stiffness(parts.samples(5, 1))
    np.testing.assert_allclose(every.responses(other), receptances.responses(other), rtol=1e-6)


def test_an_undamped_resonance_is_an_error():
    z = np.eye(12)[[2, 8]]
    receptances = prepare_receptances(two_masses(1.0), np.array([1.0, 4.0]), z, z)
    few = reduced(receptances, np.array([[0, 0, 50.0], [0, 0, 60.0]], complex))
    with pytest.raises(SolveError, match=r"no accurate response at 4\.0 Hz"):
        few.responses(np.array([[0, 0, resonant_rate(4.0)]], complex))


def test_springs_without_a_rate_do_not_matter(receptances, parts):
    drawn = parts.stiffness(np.zeros(8))
    drawn[4] = 0
    few = reduced(receptances, np.array([drawn, 1.1 * drawn, 0.9 * drawn]))
    assert worst_error(few, receptances, 1.05 * drawn[None]) < 1e-3
