"""Clocks and gauges: median times in alternating order, the machine's rate, memory."""

import multiprocessing
import os
import platform
import resource
import statistics
import sys
import time
from collections.abc import Callable, Mapping
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import ParamSpec, TypeVar

import numpy as np
import scipy
import threadpoolctl

ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""The environment in which every BLAS and every process started uses one thread."""

TURN_S = 0.3
"""What is fast is repeated for so long at each turn."""

GEMM_SIZE = 384
GEMM_OPERATIONS = 8 * GEMM_SIZE**3

P = ParamSpec("P")
T = TypeVar("T")


def in_own_process(function: Callable[P, T], *arguments: P.args, **keywords: P.kwargs) -> T:
    """What a function of a module returns, run in a new process: its peak memory is the call's own."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, context) as pool:
        return pool.submit(function, *arguments, **keywords).result()


def medians(calls: Mapping[str, Callable[[], object]], n_rounds: int) -> dict[str, float]:
    """Median seconds of each call, all in turn, in reverse order every other round."""
    times: dict[str, list[float]] = {name: [] for name in calls}
    for number in range(n_rounds):
        for name in list(calls)[:: -1 if number % 2 else 1]:
            times[name] += turn(calls[name])
    return {name: statistics.median(values) for name, values in times.items()}


def turn(call: Callable[[], object]) -> list[float]:
    """Seconds of each of the calls that fit into a turn, one at least."""
    times: list[float] = []
    while sum(times) < TURN_S:
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return times


def gemm() -> Callable[[], object]:
    """A product of complex matrices, `GEMM_OPERATIONS` real operations."""
    A = np.random.default_rng(0).standard_normal((2, GEMM_SIZE, GEMM_SIZE))
    Z = A[0] + 1j * A[1]
    return lambda: Z @ Z


def peak_bytes() -> int:
    """The most memory this process has held."""
    if sys.platform != "linux":
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    # There getrusage starts from what the parent held.
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return 1024 * int(status.partition("VmHWM:")[2].split()[0])


def machine() -> dict[str, object]:
    """What was measured on."""
    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "blas": [
            {key: library[key] for key in ("internal_api", "version", "num_threads")}
            for library in threadpoolctl.threadpool_info()
            if library["user_api"] == "blas"
        ],
        "gemm_gflops": GEMM_OPERATIONS / statistics.median(turn(gemm())) / 1e9,
    }


def _processor() -> str:
    """The processor's name, or its kind."""
    if sys.platform != "linux":
        return platform.processor()
    info = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    return info.partition("model name")[2].partition("\n")[0].lstrip("\t: ") or platform.machine()
