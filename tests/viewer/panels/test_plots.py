import numpy as np
import pytest

from modeviz.viewer.panels.plots import level_range


@pytest.mark.parametrize(
    ("low", "high", "expected"), [(-62.0, -23.0, (-70, -20)), (-140.0, -23.0, (-80, -20))]
)
def test_the_scale_is_whole_tens_and_at_most_60_db(low, high, expected):
    assert level_range(np.array([[low, -50.0], [-50.0, high]])) == expected
