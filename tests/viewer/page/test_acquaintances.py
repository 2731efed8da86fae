from modeviz.viewer.page.people import acquaintances
from modeviz.viewer.page.people.acquaintances import Acquaintances


def met(known, key, name="", is_owner=False, there=()):
    known.meet(key, name, is_owner, there)
    return known.get(key)


def test_who_comes_again_has_the_number_and_the_name_of_before():
    known = Acquaintances()
    first = met(known, "a", "Anna")
    assert met(known, "b").name == "Guest 2"
    assert met(known, "a", "Somebody") == first
    assert met(known, "o", is_owner=True).name == "Owner"


def test_who_comes_again_to_a_namesake_is_called_otherwise():
    known = Acquaintances()
    first = met(known, "a", "Anna")
    other = met(known, "b", "Anna")
    assert (other.name, other.number) == ("Anna", 2)  # the first one has left
    assert met(known, "a", there=[other]).name == "Anna 2"
    assert known.get("a").author == first.author


def test_who_was_longest_away_is_forgotten_first(monkeypatch):
    monkeypatch.setattr(acquaintances, "MOST", 3)
    known = Acquaintances()
    for key in "abcde":
        met(known, key)
    met(known, "a")
    known.forget({"b"})
    assert [key for key in "abcde" if known.get(key)] == ["a", "b", "e"]
    assert known.rename("c", "Anna", []) is None
