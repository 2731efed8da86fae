"""A search of a session that waits after its first design, so that tests meet it while it runs."""

import threading

import pytest

from modeviz.scatter import searching


def hold_searches(monkeypatch: pytest.MonkeyPatch) -> threading.Event:
    """Holds every search that begins from now on until the event is set, or it is cancelled."""
    may_go, optimise = threading.Event(), searching.optimise

    def held(search, starts, budget, token, tell):
        def hold(progress):
            tell(progress)
            while not (may_go.is_set() or token.is_cancelled):
                token.check()
                may_go.wait(0.01)

        return optimise(search, starts, budget, token, hold)

    monkeypatch.setattr(searching, "optimise", held)
    return may_go
