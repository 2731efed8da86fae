from modeviz.viewer.page.notices import LONGEST, MOST_LINES, Notices


def notices():
    said = []
    return Notices(said.append), said


def test_what_a_client_does_is_said_once_and_counted():
    noted, said = notices()
    for _ in range(30):
        noted.note("192.0.2.7", "guessed")
    noted.note("192.0.2.8", "guessed")
    assert said == ["modeviz: 192.0.2.7 guessed", "modeviz: 192.0.2.8 guessed"]
    noted.tally()
    assert said[2:] == ["modeviz: 192.0.2.7 guessed: 30 times in all"]
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
    for i in range(30):
        noted.mistake(failed(f"{i}" * 100_000))
    (line,) = said
    assert "ValueError" in line
    assert len(line) < LONGEST + 10
