"""What ten percent more of each mount rate do to the shown mode and to the ride, to first order."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeviz.export.wording import signed
from modeviz.tuning.results import AXIS
from modeviz.tuning.sensitivity import Sensitivity, rate_variables
from modeviz.vehicle.vehicle import Vehicle

TENTH = 0.1


@dataclass(frozen=True)
class Effect:
    """What ten percent more of one rate do."""

    frequency_hz: float
    """To the frequency of the shown mode."""
    lateral_percent: float
    """To the lateral RMS acceleration of the first response point."""
    vertical_percent: float


Effects = Mapping[tuple[str, str], Effect]
"""By mount group and field of `MountRates`."""


def effects(vehicle: Vehicle, sensitivity: Sensitivity, mode: int) -> Effects:
    """The effects of all rates.

    Args:
        vehicle: whose rates.
        sensitivity: of its answer.
        mode: the shown mode of that answer.
    """
    frequency_hz = TENTH * sensitivity.frequency_hz[mode]
    felt = sensitivity.rms[0] if len(sensitivity.rms) else np.zeros((3, len(frequency_hz)))
    lateral, vertical = (100 * TENTH * felt[AXIS[d]] for d in ("lateral", "vertical"))
    return {
        (v.group, v.direction): Effect(float(frequency_hz[i]), float(lateral[i]), float(vertical[i]))
        for i, v in enumerate(rate_variables(vehicle))
    }


def in_a_sentence(effect: Effect, mode: str) -> str:
    """An effect in words, for a tooltip.

    Args:
        effect: of a rate.
        mode: what the shown mode is called.
    """
    return (
        f"+10 %: {mode} {signed(effect.frequency_hz, 2)} Hz, "
        f"lateral RMS {signed(effect.lateral_percent, 1)} %, "
        f"vertical RMS {signed(effect.vertical_percent, 1)} %."
    )
