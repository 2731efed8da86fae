from functools import partial

import pytest

from modeviz.viewer.page.wire import pace as rules
from modeviz.viewer.page.wire.limits import Allowance
from modeviz.viewer.page.wire.pace import MESSAGES_PER_S, MOST_BYTES, MOST_MESSAGES, HurryError, Pace

FILE = int(MOST_BYTES)


@pytest.fixture
def pace(monkeypatch):
    """Of a page that has said nothing yet, while no time passes."""
    monkeypatch.setattr(rules, "Allowance", partial(Allowance, clock=lambda: 0.0))
    return Pace()


def test_a_page_waits_for_each_message_beyond_those_it_may_send_at_once(pace):
    assert [pace.take(1) for _ in range(int(MOST_MESSAGES))] == [0.0] * int(MOST_MESSAGES)
    waits = [pace.take(1) for _ in range(3)]
    assert waits == pytest.approx([n / MESSAGES_PER_S for n in (1, 2, 3)])


def test_a_page_that_hurries_for_long_is_refused(pace, monkeypatch):
    for _ in range(int(MOST_MESSAGES)):
        pace.take(1)
    monkeypatch.setattr(rules, "LONGEST_HURRY", -1.0)
    with pytest.raises(HurryError, match="sent more than 100 messages a second"):
        pace.take(1)


def test_more_bytes_than_fit_are_refused_unless_they_were_expected_or_asked_for(pace):
    pace.expect(2 * FILE)
    assert pace.take(2 * FILE) == 0.0
    pace.is_asked = True
    assert pace.take(2 * FILE) == 0.0
    pace.is_asked = False
    assert pace.take(FILE) == 0.0
    with pytest.raises(HurryError, match="sent more than 8 MB at once"):
        pace.take(1)
