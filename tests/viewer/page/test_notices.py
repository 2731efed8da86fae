import re

from logs import log_to

from modeviz.viewer.page.wire.notices import LONGEST, MOST_LINES, Notices


def notices():
    said = []
    return Notices(log_to(said)), said


def test_what_a_client_does_is_said_once_and_counted():
    noted, said = notices()
    for _ in range(30):
        noted.note("192.0.2.7", "guessed")
    noted.note("192.0.2.8", "guessed")
    assert said == ["192.0.2.7 guessed", "192.0.2.8 guessed"]
    noted.tally()
    assert said[2:] == ["192.0.2.7 guessed: 30 times in all"]
    noted.note("192.0.2.7", "guessed")
    assert len(said) == 4


def test_however_many_clients_there_are_few_lines_are_said():
    noted, said = notices()
    for i in range(10 * MOST_LINES):
        noted.note(f"client {i}", "guessed")
    assert len(said) == MOST_LINES + 1


def failed(text):
    try:
        raise ValueError(text)
    except ValueError as error:
        return error


def test_a_mistake_is_said_once_for_its_place_and_cut():
    noted, said = notices()
    numbers = {noted.mistake(failed(f"{i}" * 100_000)) for i in range(30)}
    (number,), (line,) = numbers, said
    assert re.fullmatch("[0-9a-f]{6}", number)
    assert line.startswith(f"mistake {number}\n")
    assert "ValueError" in line
    assert len(line) < LONGEST + 30


def test_mistakes_in_two_places_have_numbers_of_their_own():
    noted, said = notices()
    try:
        [].pop()
    except IndexError as error:
        other = noted.mistake(error)
    assert other != noted.mistake(failed("text"))
    assert len(said) == 2


def test_a_mistake_is_said_however_much_clients_do():
    noted, said = notices()
    for i in range(10 * MOST_LINES):
        noted.note(f"client {i}", "guessed")
    number = noted.mistake(failed("text"))
    assert said[-1].startswith(f"mistake {number}\n")
