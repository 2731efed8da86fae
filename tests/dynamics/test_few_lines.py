import numpy as np
import pytest
from rounding import CABIN, assert_near
from scattered_cabin import cabin_parts, cabin_receptances, drawn_and_sampled, worst_error
from small_systems import resonant_rate, two_masses

from modeviz.dynamics.few_lines import few_lines
from modeviz.dynamics.reanalysis import prepare_receptances
from modeviz.errors import SolveError

FREQUENCY_HZ = np.arange(1, 201) / 5


@pytest.fixture(scope="module")
def receptances():
    return cabin_receptances(FREQUENCY_HZ)


@pytest.fixture(scope="module")
def parts():
    return cabin_parts()


@pytest.fixture(scope="module")
def few(receptances, parts):
    return few_lines(receptances, drawn_and_sampled(parts, 64))


def test_few_frequencies_are_enough(few):
    assert few.matrix.shape[0] == len(FREQUENCY_HZ)
    assert few.matrix.shape[1] == len(few.receptances.frequency_hz) < 50


def test_parts_that_were_not_learned_from_are_answered(few, receptances, parts):
    assert worst_error(few, receptances, parts.stiffness(parts.samples(40, 1))) < 1e-3


def test_the_few_frequencies_themselves_are_exact(few, receptances, parts):
    stiffness = parts.stiffness(parts.samples(5, 2))
    own = np.isin(FREQUENCY_HZ, few.receptances.frequency_hz)
    np.testing.assert_allclose(
        few.responses(stiffness)[:, own], receptances.responses(stiffness)[:, own], rtol=1e-9
    )


def test_a_vehicle_that_never_changes_needs_one_frequency(receptances, parts):
    same = parts.stiffness(np.zeros((5, 8)))
    few = few_lines(receptances, same)
    assert few.matrix.shape[1] == 1
    expected = receptances.responses(same)
    assert_near(few.responses(same), expected, CABIN, lines=1)


def test_rounding_is_not_taken_for_change(receptances, parts):
    """Kernels may solve equal systems differently by where they stand among those solved at once."""
    size = 1e-14 * np.random.default_rng(0).normal(size=(6, 1))
    assert few_lines(receptances, parts.stiffness(np.zeros((6, 8))) * (1 + size)).matrix.shape[1] == 1


def test_an_undamped_resonance_is_an_error():
    z = np.eye(12)[[2, 8]]
    receptances = prepare_receptances(two_masses(1.0), np.array([1.0, 4.0]), z, z)
    with pytest.raises(SolveError, match=r"no accurate response at 4\.0 Hz"):
        few_lines(receptances, np.array([[0, 0, 50.0], [0, 0, resonant_rate(4.0)]], complex))
