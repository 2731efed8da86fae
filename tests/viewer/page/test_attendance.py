import pytest

from modeviz.viewer.page.people.attendance import Attendance


@pytest.fixture
def attended():
    """The owner on pages 1 and 2, Anna on 3, Ben on 4."""
    attendance = Attendance()
    for page, key, name in ((1, "own", ""), (2, "own", ""), (3, "a", "Anna"), (4, "b", "Ben")):
        attendance.enter(page, key, name, is_owner=key == "own")
    return attendance


def in_control(attendance):
    return [page for page in (1, 2, 3, 4) if attendance.has_control(page)]


def number(attendance, page):
    return attendance.of_page(page).number


def test_the_owner_is_first_and_in_control_on_every_page_of_hers(attended):
    assert [each.name for each in attended.there] == ["Owner", "Anna", "Ben"]
    assert in_control(attended) == [1, 2]
    assert attended.guest_pages == [3, 4]


def test_control_is_handed_on_by_who_has_it_and_by_the_owner_alone(attended):
    anna, ben, owner = (number(attended, page) for page in (3, 4, 1))
    assert attended.hand_over(3, anna) is None
    assert attended.hand_over(1, anna).name == "Anna"
    assert in_control(attended) == [3]
    assert attended.hand_over(4, ben) is None
    assert attended.hand_over(3, ben).name == "Ben"
    assert attended.hand_over(1, owner).is_owner
    assert in_control(attended) == [1, 2]


def test_who_presents_is_away_without_a_page_and_presents_again_on_coming_back(attended):
    attended.hand_over(1, number(attended, 3))
    assert not attended.is_away("a")
    assert attended.leave(3) == "a"
    assert attended.is_away("a")
    attended.enter(5, "a", "", is_owner=False)
    assert not attended.is_away("a")
    assert attended.has_control(5)
    attended.take_back()
    assert in_control(attended) == [1, 2]


def test_a_page_that_is_not_open_has_nobody_and_no_control(attended):
    assert attended.of_page(9) is None
    assert not attended.has_control(9)
    assert attended.leave(9) is None
    assert attended.hand_over(1, 99) is None
