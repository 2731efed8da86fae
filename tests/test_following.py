"""Modes followed from one set of rates to another."""

from dataclasses import replace

import numpy as np
from mounted_cabin import mounted_cabin

from modeviz.dynamics import band
from modeviz.tuning import following
from modeviz.tuning.following import accept, follow_rates, solve_followed
from modeviz.tuning.preparation import prepare_modes
from modeviz.tuning.results import solve_modal
from modeviz.vehicle.connections import MountRates

START = {"A": MountRates(8e5, 3e5, 0.0, loss_factor=0.0), "B": MountRates(1e5, 1e5, 1e5)}
END = {"A": MountRates(2e5, 3e5, 2e4, loss_factor=0.3), "B": MountRates(1e7, 1e7, 1e7)}


def test_rates_go_in_equal_ratios_and_from_nothing_in_equal_steps(monkeypatch):
    asked = []
    monkeypatch.setattr(
        following, "band_modes", lambda *args: asked.append(args[1]) or band.band_modes(*args)
    )
    prepared = prepare_modes(mounted_cabin())
    before, now = (solve_modal(prepared, rates) for rates in (START, END))
    follow_rates(accept(before), before, now)
    halfway = next(k for k in asked if np.isclose(k[2].real, 4e5))
    np.testing.assert_allclose(halfway[:3].real, [1e4, 3e5, 4e5], rtol=1e-12)
    np.testing.assert_allclose(halfway[:3].imag, [3e3, 4.5e4, 3e4], rtol=1e-12)
    np.testing.assert_allclose(halfway[6:], 1e6 * (1 + 0.15j), rtol=1e-12)


def test_a_loss_factor_alone_moves_no_mode():
    own = mounted_cabin().rates
    rates = {group: replace(r, loss_factor=0.4) for group, r in own.items()}
    followed = solve_followed(prepare_modes(mounted_cabin()), rates)
    n = len(followed.base.modes.frequency_hz)
    np.testing.assert_array_equal(followed.track.index, np.arange(n))
    np.testing.assert_allclose(followed.track.mac, 1.0, rtol=1e-12)
    assert (followed.now.modes.damping_ratio > followed.base.modes.damping_ratio).all()
