"""How the page shares a window, whatever its size, on the smallest vehicle."""

import pytest
from apps import open_solved_cabin
from pages import has_beside, wait_until


@pytest.fixture(scope="module")
def app(server):
    with open_solved_cabin(server) as app:
        yield app


def test_panels_are_narrower_on_a_small_page_and_on_that_alone(app, server, open_page):
    small, large = (open_page(server, viewport=(width, 500)) for width in (1280, 1600))
    wait_until(small, lambda: has_beside(small, 1280 - 300 - 380))
    wait_until(large, lambda: has_beside(large, 1600 - 376 - 484))
    assert has_beside(small, 1280 - 300 - 380)
    for page in (small, large):
        page.context.close()
