"""Code in a process of its own is held to its memory, and is given its arguments."""

import subprocess
import sys

import pytest

from modeviz.files.own_process import own_process

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="has no such limit")


def run(code: str, most_bytes: int, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = own_process(code, most_bytes, *arguments)
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_what_takes_more_memory_than_it_may_fails_and_what_takes_less_does_not():
    assert (
        run("bytes(200_000_000); print(sys.argv[1:])", 500_000_000, "a", "b c").stdout
        == "['a', 'b c']\n"
    )
    assert "MemoryError" in run("bytes(600_000_000)", 500_000_000).stderr


def test_memory_is_not_taken_by_threads_of_a_library(monkeypatch):
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "8")
    counted = "[p['num_threads'] for p in threadpoolctl.threadpool_info() if p['user_api'] == 'blas']"
    code = f"import numpy, threadpoolctl; print(max({counted}, default=1))"
    assert run(code, 1_000_000_000).stdout == "1\n"


def test_a_limit_that_is_lower_already_stays():
    code = "import resource; print(resource.getrlimit(resource.RLIMIT_AS)[1])"
    inner = own_process(code, 900_000_000)
    outer = run(f"import subprocess; subprocess.run({inner!r}, check=True)", 600_000_000)
    assert outer.stdout == "600000000\n"
