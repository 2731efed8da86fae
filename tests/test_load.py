"""Many pages at once, in short: `python -m benchmarks.load` is the long run."""

import asyncio

import pytest
from mounted_cabin import mounted_cabin

from benchmarks import load as rules
from benchmarks.load import loaded
from benchmarks.loaded_server import loaded_server
from modeviz.files import write_vehicle

N_PAGES, SECONDS = 4, 1.5


@pytest.fixture(scope="module")
def cabin(tmp_path_factory):
    folder = tmp_path_factory.mktemp("load") / "cabin"
    write_vehicle(mounted_cabin(), folder)
    return folder


@pytest.fixture(scope="module")
def server(cabin):
    with loaded_server(cabin, cabin.with_name("load.modeviz")) as server:
        yield server


@pytest.mark.parametrize("is_review", [False, True])
def test_every_screen_shows_its_own_last_rates_and_nothing_is_left(
    server, cabin, is_review, monkeypatch
):
    monkeypatch.setattr(rules, "PACE_S", (0.1, 0.3))
    found = asyncio.run(loaded(server, "short", N_PAGES, SECONDS, is_review, cabin))
    assert found.wrong == []
    assert found.during.n_sessions == (1 if is_review else N_PAGES)
    assert found.after.n_sessions == 0
    assert found.after.n_threads <= found.before.n_threads + 4  # openers stay
    assert found.after.n_files <= found.before.n_files + 4
    assert len(found.delays_ms) >= N_PAGES


def test_a_screen_of_other_rates_is_told(server, cabin, monkeypatch):
    """The harness sees what it looks for: a spectrum of rates that the numbers do not say."""
    monkeypatch.setattr("benchmarks.screen.PER_UNIT", 1.02e3)
    found = asyncio.run(loaded(server, "short", 1, 0.5, False, cabin))
    assert [what.split(" off by")[0] for what in found.wrong] == [
        "page 0: lateral spectrum",
        "page 0: vertical spectrum",
    ]
