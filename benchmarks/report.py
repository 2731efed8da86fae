"""What was measured, as the structure that `--json` writes and as tables."""

from typing import Any, TypedDict

from modeviz.report.tables import table


class MethodRow(TypedDict):
    """One method's time for the response after a change of rates."""

    method: str
    median_ms: float
    times_slower_than_modeviz: float
    max_relative_difference: float
    """From the direct solution, relative to the largest response of the same output."""


class Figures(TypedDict):
    """What modeviz does with the built-in truck."""

    event_ms: float
    """From a move of a slider, after a rest, to modes, names, spectra and rating."""
    batch_per_s: float
    """Sets of rates a second, their modes and spectra."""
    prepare_s: float
    peak_mb: float
    """Of the process that prepared and did all this."""
    gemm_floor_ratio: float
    """The median response by the time that its operations would take in a product of matrices."""
    websocket_ms: float
    """From a move of a slider to the new spectrum, through a websocket."""
    server_ms: float
    """Processor time of the whole server for such a move."""


class SizeRow(TypedDict):
    """What modeviz takes for a vehicle of some size."""

    n_dofs: int
    n_springs: int
    n_frequencies: int
    n_modes: int
    prepare_s: float
    response_ms: float
    event_ms: float
    batch_per_s: float
    peak_mb: float
    numpy_direct_ms: float
    """Scaled from a few frequencies."""


class ScatterFigures(TypedDict):
    """What it takes to drive many vehicles whose mounts scatter."""

    samples: int
    seconds: float
    """After the preparation."""
    peak_mb: float
    """Of the process that prepared and did this."""
    psd_error: float
    """How far an interpolated PSD is off at worst, a part of it."""


class OptimiseFigures(TypedDict):
    """What a search for better rates of the built-in truck takes."""

    variables: int
    """Rates that may change."""
    one_start_s: float
    """From the original rates until it has converged."""
    starts: int
    starts_s: float
    """From all of these, with choosing them and the check of the full model."""
    evaluations: int
    """From all starts."""
    found: float
    """The objective, the original's being one."""


class Report(TypedDict):
    """All of it."""

    machine: dict[str, Any]
    """With "not_installed", the peers that are missing and why."""
    comparison: list[MethodRow]
    modeviz: Figures
    scatter: ScatterFigures
    optimise: OptimiseFigures
    scaling: list[SizeRow]
    """The built-in truck first, then made-up vehicles."""


def tables(report: Report) -> str:
    """The report for a terminal."""
    return "\n\n".join(
        [
            _machine(report["machine"]),
            _comparison(report),
            _figures(report),
            _optimise(report["optimise"]),
            _scaling(report["scaling"]),
        ]
    )


def _machine(machine: dict[str, Any]) -> str:
    return (
        f"{machine['processor']}, {machine['cores']} cores, one BLAS thread: "
        f"{machine['gemm_gflops']:.1f} Gflop/s in a complex matrix product; "
        f"Python {machine['python']}, NumPy {machine['numpy']}, SciPy {machine['scipy']}"
    )


def _comparison(report: Report) -> str:
    measured = [
        [
            row["method"],
            f"{row['median_ms']:.2f}",
            f"{row['times_slower_than_modeviz']:.1f}",
            f"{row['max_relative_difference']:.1e}",
        ]
        for row in report["comparison"]
    ]
    missing = [
        [f"{method}: {reason}", "-", "-", "-"]
        for method, reason in report["machine"]["not_installed"].items()
    ]
    return table(
        ["response after a change of rates", "ms", "x modeviz", "largest difference"],
        measured + missing,
    )


def _figures(report: Report) -> str:
    figures, scatter = report["modeviz"], report["scatter"]
    return table(
        ["modeviz on the built-in truck", ""],
        [
            ["slider to modes, spectra and rating, ms", f"{figures['event_ms']:.1f}"],
            ["the same through a websocket, ms", f"{figures['websocket_ms']:.1f}"],
            ["processor time of the server for it, ms", f"{figures['server_ms']:.1f}"],
            ["sets of rates in a batch, 1/s", f"{figures['batch_per_s']:.0f}"],
            [f"{scatter['samples']} scattered trucks, s", f"{scatter['seconds']:.1f}"],
            ["peak memory of that, MB", f"{scatter['peak_mb']:.0f}"],
            ["preparation, s", f"{figures['prepare_s']:.2f}"],
            ["peak memory, MB", f"{figures['peak_mb']:.0f}"],
            ["response by the time of its flops in gemm", f"{figures['gemm_floor_ratio']:.1f}"],
        ],
    )


def _optimise(figures: OptimiseFigures) -> str:
    return table(
        [f"the paper's problem, {figures['variables']} rates free", ""],
        [
            ["from the original rates, s", f"{figures['one_start_s']:.2f}"],
            [f"from {figures['starts']} starts, s", f"{figures['starts_s']:.1f}"],
            ["evaluations of that", f"{figures['evaluations']}"],
            ["objective by the original's", f"{figures['found']:.3f}"],
        ],
    )


def _scaling(rows: list[SizeRow]) -> str:
    header = ["coordinates", "springs", "freqs", "modes", "prepare s", "response ms", "event ms"]
    return table(
        [*header, "batch 1/s", "peak MB", "direct ms"],
        [
            [
                *(str(row[key]) for key in ("n_dofs", "n_springs", "n_frequencies", "n_modes")),
                f"{row['prepare_s']:.2f}",
                f"{row['response_ms']:.2f}",
                f"{row['event_ms']:.1f}",
                f"{row['batch_per_s']:.3g}",
                f"{row['peak_mb']:.0f}",
                f"{row['numpy_direct_ms']:.0f}",
            ]
            for row in rows
        ],
    )
