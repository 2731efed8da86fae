"""Where the modes with one set of rates are with another."""

from dataclasses import dataclass

from modeviz.analysis.preparation import PreparedModes
from modeviz.analysis.results import ModalResults, solve_modal
from modeviz.dynamics.band import Method
from modeviz.dynamics.tracking import Track, track_modes
from modeviz.vehicle.connections import Rates


@dataclass(frozen=True, eq=False)
class Followed:
    """The modes with the vehicle's own rates, those with other rates, and where the former went."""

    base: ModalResults
    now: ModalResults
    track: Track
    """From the modes of `base` to those of `now`."""


def solve_followed(prepared: PreparedModes, rates: Rates, method: Method = "enriched") -> Followed:
    """The modes with other mount rates, and which they are of those with the vehicle's own.

    Arguments and errors as `analysis.results.solve_modal`.
    """
    base, now = (solve_modal(prepared, r, method) for r in ({}, rates))
    return Followed(base, now, follow(base, now))


def follow(base: ModalResults, now: ModalResults) -> Track:
    """Where the modes of one set of rates are with another of the same vehicle."""
    return track_modes(base.momentum, base.modes, now.modes)
