"""The peaks of a response, and the modes that make them, by their names."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from modeviz.analysis.results import Results
from modeviz.ride.participation import Contributor, Peak
from modeviz.text.markup import table
from modeviz.vehicle.arrays import Floats


@dataclass(frozen=True)
class PeakPart:
    """A mode's part in a peak."""

    name: str
    """Of the mode: "cab yaw", or of what is left."""
    is_weak: bool
    """Whether the name fits weakly."""
    frequency_hz: float | None
    """Of the mode; None for what is left of all modes above the band."""
    ratio: float
    """Of its part to the largest one."""

    @property
    def spoken(self) -> str:
        """The name as it is shown: "~cab yaw" where it fits weakly."""
        return f"~{self.name}" if self.is_weak else self.name


@dataclass(frozen=True)
class ResponsePeak:
    """A peak of a response, and the modes that make it."""

    frequency_hz: float
    level: float
    """Of the response there: g²/Hz on a road, g under a wheel load."""
    parts: tuple[PeakPart, ...]
    """The largest first."""


def named_peaks(results: Results, peaks: tuple[Peak, ...]) -> tuple[ResponsePeak, ...]:
    """Return peaks with the modes that make them by their names."""
    return tuple(
        ResponsePeak(
            peak.frequency_hz,
            peak.level,
            tuple(_named(results, contributor) for contributor in peak.contributors),
        )
        for peak in peaks
    )


def _named(results: Results, contributor: Contributor) -> PeakPart:
    spoken = results.part_name(contributor.mode)
    return PeakPart(
        spoken.removeprefix("~"),
        spoken.startswith("~"),
        results.part_frequency(contributor.mode),
        contributor.ratio,
    )


def peaks_table(
    peaks: Mapping[str, Sequence[ResponsePeak]], decibels: Callable[[Floats], Floats], unit: str
) -> str:
    """Return a table of the peaks of some directions as HTML.

    Args:
        peaks: by the direction.
        decibels: of their levels.
        unit: of these.
    """
    rows = [
        [
            escape(direction),
            f"{peak.frequency_hz:.1f}",
            f"{float(decibels(np.array(peak.level))):.1f}",
            escape(", ".join(f"{part.spoken} {part.ratio:.2f}" for part in peak.parts)),
        ]
        for direction, found in peaks.items()
        for peak in found
    ]
    return table(["Peak", "Hz", unit, "Modes in it"], rows, words=(3,))
