"""`python -m benchmarks`: modeviz beside others that do the same work, and against its own size."""

import argparse
import json
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import ParamSpec, TypeVar

from benchmarks.compare import compare
from benchmarks.figures import figures
from benchmarks.measure import ONE_THREAD, in_own_process, machine
from benchmarks.optimise import optimise_figures
from benchmarks.report import Figures, Report, tables
from benchmarks.scaled_vehicle import Size
from benchmarks.scatter import scatter_figures
from benchmarks.websocket import drag

N_FREQS, N_ROUNDS, N_MOVES, N_SAMPLES, N_STARTS = 400, 3, 60, 10_000, 20
SIZES = [
    (Size(n_wagons=4, n_modes=50, n_mounts=3), 400, 40.0),
    (Size(n_wagons=4, n_modes=250, n_mounts=3), 100, 40.0),
    (Size(n_wagons=4, n_modes=250, n_mounts=3), 200, 40.0),
    (Size(n_wagons=4, n_modes=250, n_mounts=3), 400, 40.0),
    (Size(n_wagons=4, n_modes=250, n_mounts=3), 400, 20.0),
    (Size(n_wagons=4, n_modes=250, n_mounts=3), 400, 80.0),
    (Size(n_wagons=4, n_modes=250, n_mounts=11), 400, 40.0),
    (Size(n_wagons=4, n_modes=500, n_mounts=3), 400, 40.0),
    (Size(n_wagons=5, n_modes=400, n_mounts=25), 400, 40.0),
]
"""Vehicles of 200 to 2000 coordinates with 27 to 300 springs, at how many frequencies
and with modes up to how many hertz."""

QUICK = 20, 1, 5, 100, 2
QUICK_SIZES = [(Size(n_wagons=3, n_modes=20, n_mounts=1), 20, 40.0)]

P = ParamSpec("P")
T = TypeVar("T")


def main(arguments: Sequence[str] | None = None) -> None:
    """Measures, prints tables and writes what was asked for."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="few frequencies: shows that all works")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures there too")
    options = parser.parse_args(arguments)
    os.environ.update(ONE_THREAD)
    report = measure(*QUICK, QUICK_SIZES) if options.quick else measure()
    print(tables(report))
    if options.json:
        options.json.write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")


def measure(
    n_freqs: int = N_FREQS,
    n_rounds: int = N_ROUNDS,
    n_moves: int = N_MOVES,
    n_samples: int = N_SAMPLES,
    n_starts: int = N_STARTS,
    sizes: Sequence[tuple[Size, int, float]] = SIZES,
) -> Report:
    """Everything, each part in a process of its own.

    Args:
        n_freqs: frequencies on the truck.
        n_rounds: turns of each method.
        n_moves: of a slider in the page.
        n_samples: trucks whose mounts scatter.
        n_starts: of a search for better rates.
        sizes: other vehicles, with their number of frequencies and the top of their band, Hz.
    """
    comparison = _run("the methods", compare, n_freqs, n_rounds)
    truck = _run("the truck", figures, None, n_freqs)
    scattered = _run("scatter", scatter_figures, n_samples, n_freqs)
    search = _run("the search", optimise_figures, n_starts)
    page = _run("the page", drag, n_moves)
    others = [_run(f"{size}, {n} frequencies", figures, size, n, top) for size, n, top in sizes]
    return Report(
        machine={**in_own_process(machine), "not_installed": comparison.not_installed},
        comparison=comparison.rows,
        modeviz=Figures(
            event_ms=truck["event_ms"],
            batch_per_s=truck["batch_per_s"],
            prepare_s=truck["prepare_s"],
            peak_mb=truck["peak_mb"],
            gemm_floor_ratio=comparison.gemm_floor_ratio,
            websocket_ms=page.websocket_ms,
            server_ms=page.server_ms,
        ),
        scatter=scattered,
        optimise=search,
        scaling=[truck, *others],
    )


def _run(what: str, function: Callable[P, T], *arguments: P.args, **keywords: P.kwargs) -> T:
    """Says what is measured, and measures it."""
    print(f"measuring {what}", file=sys.stderr, flush=True)
    return in_own_process(function, *arguments, **keywords)


if __name__ == "__main__":
    main()
