import numpy as np
import pytest

from modeviz.ride.rating import mean_personal_rating, rate, weight_d, weight_k, weighted_rms
from modeviz.units import STANDARD_GRAVITY

# ISO 2631-1:1997, table 3, weights × 1000 at the nominal frequencies.
ISO_HZ = np.array([0.5, 1.0, 2.0, 4.0, 5.0, 8.0, 16.0, 31.5, 80.0])
ISO_WK = np.array([418, 482, 531, 967, 1039, 1036, 768, 405, 132])
ISO_WD = np.array([853, 1011, 890, 512, 409, 253, 125, 63.2, 21.1])


def test_vertical_weights_are_the_standards():
    # The printed values are rounded and belong to the exact third-octave centres, hence 0.7.
    assert weight_k(ISO_HZ) * 1000 == pytest.approx(ISO_WK, abs=0.71)
    assert weight_k(np.array([1.0, 5.0, 8.0, 16.0])) * 1000 == pytest.approx(
        [482, 1039, 1036, 769], abs=0.5
    )


def test_horizontal_weights_are_the_standards():
    assert weight_d(ISO_HZ) * 1000 == pytest.approx(ISO_WD, abs=0.5)


def test_rating_changes_a_point_for_an_eightieth_of_g():
    """The paper's truck: -0.0330 g is 2.64 points."""
    assert mean_personal_rating(0.099) - mean_personal_rating(0.132) == pytest.approx(2.64)
    assert mean_personal_rating(0.0) == 10.9


def flat(*levels: float) -> tuple[np.ndarray, np.ndarray]:
    f = np.linspace(0.1, 40.1, 401)
    return f, np.tile(levels, (401, 1))


def test_rating_combines_lateral_and_vertical_from_0_to_40_hz():
    rating = rate(*flat(5.0, 9e-6, 16e-6))
    span = 39.9
    assert rating.rms_lateral_g == pytest.approx(3e-3 * np.sqrt(span), rel=1e-9)
    assert rating.rms_vertical_g == pytest.approx(4e-3 * np.sqrt(span), rel=1e-9)
    assert rating.combined_g == pytest.approx(5e-3 * np.sqrt(span), rel=1e-9)
    assert rating.mean_personal_rating == pytest.approx(10.9 - 0.4 * np.sqrt(span), rel=1e-9)
    assert rating.note == ""


@pytest.mark.parametrize("power", [1e-12, 1.0])
def test_rating_off_the_scale_is_shown_with_a_note(power):
    rating = rate(*flat(0.0, power, power))
    assert not 0 <= rating.mean_personal_rating <= 10
    assert "outside of the scale" in rating.note


def test_narrow_vibration_is_weighted_by_its_own_weight():
    """A line at 8 Hz of 0.1 g; the standard's rounding leaves 0.2 %."""
    f = np.array([0.5, 7.99, 8.0, 8.01, 80.0])
    G = np.zeros((5, 3))
    G[2] = 0.1**2 / 0.01
    horizontal, vertical = 0.0253 * STANDARD_GRAVITY, 0.1036 * STANDARD_GRAVITY
    assert weighted_rms(f, G) == pytest.approx((horizontal, horizontal, vertical), rel=2e-3)
    total = rate(f, G).weighted_total
    assert total == pytest.approx(np.sqrt(2 * horizontal**2 + vertical**2), rel=2e-3)


def test_weighted_value_counts_frequencies_above_the_papers_band():
    f = np.linspace(40.0, 80.0, 401)
    assert weighted_rms(f, np.ones((401, 3)))[2] > 0.1 * STANDARD_GRAVITY * np.sqrt(40.0)
