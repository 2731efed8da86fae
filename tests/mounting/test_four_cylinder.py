"""A public study's engine: what was solved independently of modeviz."""

import numpy as np
import pytest
from four_cylinder import (
    CENTER,
    ELASTIC_TORQUE,
    ENERGY,
    FREQUENCIES,
    TORQUE_ROLL,
    engine,
    four_cylinder,
)

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.rigid import rigid_figures


@pytest.fixture(scope="module")
def figures():
    return rigid_figures(solve_modal(prepare_modes(four_cylinder()), {}))[0]


def test_frequencies_have_four_digits(figures):
    assert figures.purity.frequency_hz == pytest.approx(FREQUENCIES, abs=5e-5)


def test_the_energy_table_is_that_of_the_study(figures):
    assert 100 * figures.purity.energy == pytest.approx(np.array(ENERGY), abs=0.1)


def test_axes_have_four_decimals(figures):
    axes = figures.axes
    assert axes.torque_roll_axis.direction == pytest.approx(TORQUE_ROLL, abs=5e-5)
    for held in (axes.held, axes.mounted):
        assert held.torque_axis.direction == pytest.approx(ELASTIC_TORQUE, abs=5e-5)
        assert np.degrees(held.angle) == pytest.approx(12.041, abs=5e-4)


def test_each_direction_has_the_mode_with_most_of_it(figures):
    assert figures.purity.modes == (1, 0, 3, 4, 5, 2)
    assert [figures.purity.is_pure(m) for m in ("x", "y", "z", "rx", "ry", "rz")] == [
        True, True, False, True, True, False,
    ]  # fmt: skip
    assert not figures.purity.is_in_band("ry")
    assert not figures.purity.passes


def test_a_crank_that_is_said_is_that_of_the_torque():
    along_x = four_cylinder(engine(crank_axis=np.array([2.0, 0.0, 0.0])))
    axes = rigid_figures(solve_modal(prepare_modes(along_x), {}))[0].axes
    assert axes.crank.tolist() == [1.0, 0.0, 0.0]
    assert np.argmax(np.abs(axes.torque_roll_axis.direction)) == 0
    assert axes.torque_roll_axis.point == pytest.approx(CENTER)
