import pytest

from modeviz.viewer.page.widgets.layout import NARROW, NARROW_BELOW, WIDE, WIDE_ABOVE, fitting


@pytest.mark.parametrize(
    ("window", "fitted"), [(1280, NARROW), (1440, NARROW), (1536, WIDE), (1920, WIDE), (3840, WIDE)]
)
def test_panels_are_narrow_in_a_small_window_and_stay_as_they_were_fitted(window, fitted):
    """With panels of 376 + 484 pixels, or 300 + 380."""
    beside = {WIDE: window - 860, NARROW: window - 680}
    settled = fitting(beside[WIDE], WIDE)
    assert settled == fitted
    assert fitting(beside[settled], settled) == settled


def test_a_page_that_widens_gets_its_wide_panels_back():
    assert fitting(WIDE_ABOVE + 1, NARROW) == WIDE
    assert fitting(NARROW_BELOW, WIDE) == WIDE
