"""How often somebody may guess at a token."""

import sys
import threading

import pytest

from modeviz.viewer.page.doors.guesses import (
    DELAY,
    FREE_GUESSES,
    LOCKED_S,
    MOST_CLIENTS,
    MOST_GUESSES,
    Guesses,
)


def test_who_guesses_waits_and_is_locked_out_and_others_are_not():
    now = [0.0]
    guesses = Guesses(lambda: now[0])
    delays = []
    for _ in range(MOST_GUESSES):
        assert not guesses.locked("a")
        delays.append(guesses.note("a"))
    assert delays == [0.0] * FREE_GUESSES + [DELAY] * (MOST_GUESSES - FREE_GUESSES)
    assert guesses.locked("a") == LOCKED_S
    assert not guesses.locked("b")
    now[0] = LOCKED_S + 1
    assert not guesses.locked("a")


def test_the_right_token_makes_wrong_ones_forgotten():
    guesses = Guesses()
    for _ in range(3 * MOST_GUESSES):
        guesses.note("a")
        guesses.forget("a")
    assert not guesses.locked("a")


def test_few_clients_are_remembered():
    guesses = Guesses()
    clients = [f"client {i}" for i in range(3 * MOST_CLIENTS)]
    for i, client in enumerate(clients):
        for _ in range(MOST_GUESSES if i % 2 else 1):
            guesses.note(client)
    remembered = [client for client in clients if guesses.locked(client)]
    assert 0 < len(remembered) <= MOST_CLIENTS
    assert guesses.locked(clients[-1])


@pytest.fixture
def often_interrupted():
    """Threads that take turns as often as they can."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(before)


def test_guesses_of_several_threads_are_all_counted(often_interrupted):
    """Each guesses once less than would lock it out if all of them were one."""
    guesses, n_threads = Guesses(), 9
    errors = []

    def guess(own):
        try:
            for i in range(100):
                guesses.note(f"{own} {i}")
            guesses.note("all")
        except KeyError as error:
            errors.append(error)

    threads = [threading.Thread(target=guess, args=(own,)) for own in range(n_threads)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not errors
    assert not guesses.locked("all")
    guesses.note("all")
    assert guesses.locked("all") > 0
