"""What ten percent more of each mount rate do to the shown mode and to the ride, to first order."""

from collections.abc import Mapping
from dataclasses import dataclass

from modeviz.analysis.results import AXIS
from modeviz.analysis.sensitivity import Sensitivity, rate_variables
from modeviz.report.rate_fields import is_damping
from modeviz.text.wording import signed
from modeviz.vehicle.vehicle import Vehicle

TENTH = 0.1


@dataclass(frozen=True)
class Effect:
    """The effect of ten percent more of one rate."""

    frequency_hz: float
    """To the frequency of the shown mode."""
    lateral_percent: float | None
    """To the lateral RMS acceleration of the first response point; None where there is no point."""
    vertical_percent: float | None
    damping_ratio: float | None = None
    """To the damping ratio of the shown mode, of a damper; None of stiffness."""

    @property
    def of_mode(self) -> str:
        """What it does to the shown mode: "+0.12 Hz", or "ζ +0.4 %" of a damper."""
        if self.damping_ratio is None:
            return f"{signed(self.frequency_hz, 2)} Hz"
        return f"ζ {signed(100 * self.damping_ratio, 2)} %"


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
    percent = 100 * TENTH * sensitivity.rms[:1, [AXIS["lateral"], AXIS["vertical"]]]
    felt = percent[0].T.tolist() if len(percent) else [(None, None)] * len(frequency_hz)
    ratio = (TENTH * sensitivity.damping_ratio[mode]).tolist()
    return {
        (v.group, v.direction): Effect(
            float(frequency_hz[i]),
            *felt[i],
            damping_ratio=ratio[i] if is_damping(v.direction) else None,
        )
        for i, v in enumerate(rate_variables(vehicle))
    }


def in_a_sentence(effect: Effect, mode: str) -> str:
    """An effect in words, for a tooltip.

    Args:
        effect: of a rate.
        mode: what the shown mode is called.
    """
    felt = {"lateral": effect.lateral_percent, "vertical": effect.vertical_percent}
    parts = [f"{mode} {effect.of_mode}"]
    parts += [f"{d} RMS {signed(percent, 1)} %" for d, percent in felt.items() if percent is not None]
    return f"+10 %: {', '.join(parts)}."
