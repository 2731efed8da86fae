import numpy as np
import pytest

from modeviz.vehicle.srgb import linear_to_srgb, srgb_to_linear


def test_middle_grey_of_srgb_reflects_a_fifth_of_the_light():
    # IEC 61966-2-1: code value 119 is 18.4 % linear; the line and the curve meet at 0.04045
    assert srgb_to_linear(119 / 255) == pytest.approx(0.1845, abs=5e-5)
    assert srgb_to_linear([0, 0.04045, 1]) == pytest.approx([0, 0.0031308, 1], abs=1e-7)


def test_linear_to_srgb_undoes_srgb_to_linear():
    values = np.arange(256) / 255
    assert linear_to_srgb(srgb_to_linear(values)) == pytest.approx(values, abs=1e-6)
