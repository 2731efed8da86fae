import os
import signal
import time
from dataclasses import replace

import numpy as np
import pytest
from cabin_problem import PROBLEM, cabin_search
from distributed import LocalCluster
from mounted_cabin import mounted_cabin
from scattered_cabin import FLAT, cabin_objective, prepared_cabin

from modeviz.analysis.batch import SENT, solve_many
from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.compute.cluster import runner_at
from modeviz.errors import ModevizError
from modeviz.files import write_vehicle
from modeviz.optimise.run import optimise, optimise_on
from modeviz.optimise.starts import start_points
from modeviz.scatter.monte_carlo import CHUNK, scatter
from modeviz.scatter.tolerance import Tolerance, scattered_parts


def cluster(n_workers):
    """A scheduler with workers that are processes of their own."""
    return LocalCluster(
        n_workers=n_workers,
        threads_per_worker=1,
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",
    )


@pytest.fixture(scope="module")
def address():
    with cluster(2) as own:
        yield own.scheduler_address


@pytest.fixture(scope="module")
def study():
    prepared = prepared_cabin()
    return prepared, scattered_parts(prepared, {}, Tolerance()), FLAT, cabin_objective()


@pytest.mark.bitwise
def test_numbers_are_the_same_to_the_last_digit(address, study):
    n_samples = 3 * CHUNK + 30
    here = scatter(*study, n_samples, seed=2)
    with runner_at(address) as runner:
        there = scatter(*study, n_samples, seed=2, runner=runner)
    for name in ("deviations", "rms", "psd", "goal"):
        np.testing.assert_array_equal(getattr(there, name), getattr(here, name))


@pytest.mark.bitwise
def test_searches_find_the_same_to_the_last_digit(address):
    search = cabin_search()
    starts = start_points(search, {}, 4)
    here = optimise(search, starts)
    with runner_at(address) as runner:
        there = optimise_on(runner, search, starts)
    np.testing.assert_array_equal(there.x, here.x)
    assert [d.value for d in there.descents] == [d.value for d in here.descents]
    assert (there.value, there.reason, there.evaluations) == (here.value, here.reason, here.evaluations)


@pytest.mark.bitwise
def test_modeviz_optimise_says_the_same_with_a_scheduler(address, printed_json, tmp_path):
    write_vehicle(replace(mounted_cabin(), problems=(PROBLEM,)), tmp_path / "cabin")
    command = "optimise", str(tmp_path / "cabin"), "--starts", "3"
    assert printed_json(*command, "--scheduler", address) == printed_json(*command)


@pytest.mark.bitwise
def test_sweeps_are_the_same_to_the_last_digit(address, study):
    prepared, parts, conditions, _ = study
    stiffness = parts.stiffness(parts.samples(SENT + 20, 0))
    (here,) = solve_many(prepared, stiffness, conditions)
    with runner_at(address) as runner:
        first, second = solve_many(prepared, stiffness, conditions, runner=runner)
    assert (first.start, second.start) == (0, SENT)
    for name in ("frequency_hz", "psd", "rms"):
        there = np.concatenate([getattr(first, name), getattr(second, name)])
        np.testing.assert_array_equal(there, getattr(here, name))


def slowly_squared(shared, item):
    time.sleep(0.05)
    return os.getpid(), shared * item**2


def test_a_lost_worker_is_survived(address):
    """The first worker that answers is killed, with all it was to do and what it was sent."""
    with runner_at(address) as runner:
        results = []
        for result in runner.map(slowly_squared, 3, range(40), CancelToken()):
            if not results:
                os.kill(result[0], signal.SIGKILL)
            results.append(result)
    assert [value for _, value in results] == [3 * n**2 for n in range(40)]
    assert len({pid for pid, _ in results}) > 1


def test_cancel_answers_at_once(address):
    token = CancelToken()
    with runner_at(address) as runner:
        token.cancel()
        start = time.monotonic()
        with pytest.raises(CancelledError):
            next(runner.map(slowly_squared, 1, range(3), token))
        assert time.monotonic() - start < 10


def fails(shared, item):
    raise ModevizError(f"item {item} is bad")


def test_what_fails_there_fails_here_in_the_same_words(address):
    with runner_at(address) as runner, pytest.raises(ModevizError, match=r"^item 0 is bad$"):
        next(runner.map(fails, None, range(3), CancelToken()))


def lacks(shared, item):
    import modeviz.nothing  # noqa: F401


def test_workers_without_the_same_modeviz_are_an_error(address):
    answer = pytest.raises(ModevizError, match=r"^the workers need the same modeviz as here: No module")
    with runner_at(address) as runner, answer:
        next(runner.map(lacks, None, range(3), CancelToken()))


def test_a_lost_scheduler_is_an_error():
    answer = pytest.raises(ModevizError, match=r"^the scheduler is lost; start it and this again$")
    with cluster(1) as own, answer, runner_at(own.scheduler_address) as runner:
        for _ in runner.map(slowly_squared, 3, range(1000), CancelToken()):
            own.close()


def test_a_scheduler_without_workers_is_an_error(monkeypatch):
    monkeypatch.setattr("modeviz.compute.cluster.TIMEOUT_S", 1.0)
    answer = pytest.raises(ModevizError, match=r"it has no workers; start one with dask worker tcp://")
    with cluster(0) as own, answer, runner_at(own.scheduler_address):
        pass


@pytest.mark.parametrize(
    "address",
    [
        "tcp://127.0.0.1:9",
        "tcp://127.0.0.1:99999",
        "tcp://127.0.0.1",
        "http://127.0.0.1:9",
        "nonsense",
        "",
    ],
)
def test_a_scheduler_that_is_not_there_is_one_sentence_within_seconds(address):
    start = time.monotonic()
    answer = pytest.raises(ModevizError, match=r"nobody answers there; expected the address")
    with answer as error, runner_at(address):
        pass
    assert time.monotonic() - start < 10
    assert str(error.value).startswith(f"scheduler {address!r}")
