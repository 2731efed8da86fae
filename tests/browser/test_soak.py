"""A short version of `python -m benchmarks.soak`, in a process of its own."""

import subprocess
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).parents[2]


@pytest.mark.slow
def test_page_and_solver_agree_after_random_use():
    command = [sys.executable, "-m", "benchmarks.soak", "--actions", "60", "--minutes", "0"]
    done = subprocess.run(command, cwd=CHECKOUT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.splitlines()[-1] == "page and solver agree"
