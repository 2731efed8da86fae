"""The report on mounts that are moved, against the vehicle as it was."""

from datetime import date
from functools import partial

import numpy as np
import pytest
from mounted_cabin import mounted_cabin

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html import report
from modeviz.vehicle.placement import Placement, with_placements

FLAT = Conditions("flat", 20.0)


def test_each_side_is_solved_with_its_mounts_where_they_are_there():
    placed = partial(with_placements, mounted_cabin())
    was, now = (prepare(placed({"A": Placement((x, 0, 0))})) for x in (0.05, 0.2))
    comparison = compare(now, RateSet("Mine", {}), RateSet("Trial 2", {}), FLAT, was)
    for results, prepared in ((comparison.base, was), (comparison.now, now)):
        expected = solve(prepared, {}, FLAT)
        assert results.modes.frequency_hz == pytest.approx(expected.modes.frequency_hz, rel=1e-12)
        np.testing.assert_allclose(results.psd, expected.psd, rtol=1e-9)
    page = report(comparison, date(2026, 1, 1), (), None)
    assert "mounts &#x27;A&#x27; are moved by 200, 0, 0 mm" in page
    assert "Mine: mounts &#x27;A&#x27; are moved by 50, 0, 0 mm" in page
