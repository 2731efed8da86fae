"""Memory that is given back to the system."""

import subprocess
import sys

import pytest

PROGRAM = """
from pathlib import Path

from modeviz.compute.memory import give_back

def resident():
    return int(Path("/proc/self/statm").read_text().split()[1])

before = resident()
held = [bytes(1000) for _ in range(200_000)]
full = resident()
kept = held[-1]
del held
give_back()
print(full - before, resident() - before, len(kept))
"""
"""Fills memory and frees it but for its end, and prints the pages that were and are in memory."""


@pytest.mark.skipif(sys.platform != "linux", reason="the memory is told so by Linux alone")
def test_freed_memory_is_given_back_but_for_what_is_still_used():
    ran = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True)
    full, left, kept = map(int, ran.stdout.split())
    assert full > 40_000
    assert left < full / 2
    assert kept == 1000
