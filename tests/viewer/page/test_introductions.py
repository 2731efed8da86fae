"""Names and keys that strangers say are theirs."""

from types import SimpleNamespace
from urllib.parse import urlencode

import pytest

from modeviz.viewer.page.people.introductions import LONGEST_NAME, introduction, is_review, person_name

KEY = "abcdefghij-KLMNOP_1234"


def asked(**query):
    return SimpleNamespace(path=f"/?{urlencode(query)}")


@pytest.mark.parametrize(
    "name", ["Anna", "Jürgen Müller-Lüdenscheidt", "O'Brien", "王伟", "नमस्ते", "A. (CAE)"]
)
def test_a_name_of_letters_stays(name):
    assert person_name(name) == name


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("  Anna \t\n Berg ", "Anna Berg"),
        ("<img src=x onerror=alert(1)>", "img srcx onerroralert(1)"),
        ("a\u202e\u200b\x00b", "ab"),
        ("Z" + "\u0353" * 60, "Z\u0353\u0353"),
        ("`*_[x]", "_x"),
        ("\u202e<>", ""),
    ],
)
def test_what_would_alter_another_page_is_left_out_of_a_name(name, shown):
    assert person_name(name) == shown


def test_a_name_is_short():
    assert person_name("n" * 10_000) == "n" * LONGEST_NAME


def test_a_browser_is_known_by_its_key_and_one_without_is_new():
    assert introduction(asked(visitor=KEY, name="Anna")).key == KEY
    for bad in ("short", "x" * 65, "<script>" * 4):
        keys = {introduction(asked(visitor=bad)).key for _ in range(2)}
        assert len(keys) == 2
        assert bad not in keys


def test_the_link_of_a_review_is_known_whatever_else_stands_in_it():
    assert is_review(asked(session="s", review="r"))
    assert is_review(asked(review=""))
    assert not is_review(asked(session="review"))
