"""Memory that is given back to the system."""

import sys
from pathlib import Path

import pytest

from modeviz.compute.memory import give_back


def resident() -> int:
    """Pages that this process has in memory."""
    return int(Path("/proc/self/statm").read_text().split()[1])


@pytest.mark.skipif(sys.platform != "linux", reason="the memory is told so by Linux alone")
def test_freed_memory_is_given_back_but_for_what_is_still_used():
    before = resident()
    held = [bytes(1000) for _ in range(200_000)]
    full = resident()
    kept = held[-1]
    del held
    give_back()
    assert full - before > 40_000
    assert resident() - before < (full - before) / 2
    assert len(kept) == 1000
