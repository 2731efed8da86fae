"""Stills, which need no browser: what moves is in them whole, on the page's background."""

from dataclasses import replace

import numpy as np
import pytest
from cabin_session import SOON, open_session

from modeviz.viewer.pictures.still import still
from modeviz.viewer.scene.stage import DARK, LIGHT
from modeviz.viewer.session.commands.looks import ChangeMotion

SIZE = 320, 160


@pytest.fixture(scope="module")
def session():
    with open_session() as (session, _):
        yield session


def drawn(solved, dark=False):
    """Where a still differs from its background, (height, width)."""
    pixels = np.asarray(still(solved, dark, *SIZE)).astype(int)
    return np.abs(pixels - pixels[:, :1]).max(axis=2) > 8


@pytest.mark.parametrize("dark", [False, True])
def test_what_moves_is_whole_and_fills_the_still(session, dark):
    where = drawn(session.answer, dark)
    rows, columns = np.flatnonzero(where.any(axis=1)), np.flatnonzero(where.any(axis=0))
    assert rows[0] > 0
    assert columns[0] > 0
    assert columns[-1] < SIZE[0] - 1
    assert len(rows) > 0.7 * SIZE[1] or len(columns) > 0.7 * SIZE[0]


def test_the_background_is_that_of_the_page(session):
    for dark, theme in ((False, LIGHT), (True, DARK)):
        corner = np.asarray(still(session.answer, dark, *SIZE))[0, 0]
        assert np.abs(corner.astype(int) - theme.top).max() <= 1


def test_another_motion_is_another_picture(session):
    before = np.asarray(still(session.answer, False, *SIZE))
    session.do(ChangeMotion(kind="operating shape"))
    assert session.wait(SOON)
    assert np.any(np.asarray(still(session.answer, False, *SIZE)) != before)


def test_the_nearest_side_of_a_block_hides_the_others(session):
    """Opaque, it has the shades of the three sides that a camera sees of a block, no more."""
    solved = session.answer
    look = replace(solved.state.look, see_through=False)
    opaque = replace(solved, state=replace(solved.state, look=look))
    through, hidden = (
        still(each, False, *SIZE).getcolors(SIZE[0] * SIZE[1]) for each in (solved, opaque)
    )
    assert len(hidden) < len(through)
