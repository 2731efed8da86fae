"""Dampers that give modes of a vehicle the damping ratio that was measured.

    C' = C + Σ c_r (M φ_r)(M φ_r)ᵀ,  c_r = 2 ω_r (ζ_r - ζ_r,model)

A damper along M φ_r takes energy from mode r alone, for φ_sᵀ M φ_r = 0 (R. W. Clough, J. Penzien,
"Dynamics of Structures", 2nd ed., section 12-4).
"""

from dataclasses import replace

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.modes import RESOLVED_HZ, Modes, solve_modes
from modeviz.dynamics.naming import name_modes, prepare_names
from modeviz.errors import VehicleError, unknown
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mode_damping import ModeDamping

EQUAL = 1e-9
"""A ratio less than what a mode has, by no more than this, is the same."""


def with_mode_damping(system: System, top_hz: float) -> System:
    """The system with dampers that bring modes to the ratios that its vehicle states.

    Args:
        system: without them.
        top_hz: modes below this can be named.

    Raises:
        VehicleError: there is no such mode, it moves freely, or it is damped more already.
        SolveError: as `solve_modes`.
    """
    stated = system.vehicle.mode_damping
    if not stated:
        return system
    modes = solve_modes(system, below_hz=top_hz)
    ratios = _ratios(system, modes, stated)
    damped = np.flatnonzero(~np.isnan(ratios))
    rows = system.momentum(modes.shapes[:, damped]).T
    missing = np.maximum(ratios[damped] - modes.damping_ratio[damped], 0.0)
    coefficients = 4 * np.pi * modes.frequency_hz[damped] * missing
    return replace(
        system,
        damping=system.damping + (rows.T * coefficients) @ rows,
        mode_dampers=rows,
        mode_damping=coefficients,
    )


def _ratios(system: System, modes: Modes, stated: tuple[ModeDamping, ...]) -> Floats:
    """The ratio stated for each mode, (n_modes,), not a number where there is none."""
    names = [name.name for name in name_modes(prepare_names(system), modes)]
    vibrates = modes.frequency_hz > RESOLVED_HZ
    ratios = np.full(len(names), np.nan)
    for damping in sorted(stated, key=lambda d: d.mode is not None):
        if damping.mode is None:
            ratios[vibrates] = np.maximum(damping.damping_ratio, modes.damping_ratio[vibrates])
            continue
        number = _number(damping, names)
        own = float(modes.damping_ratio[number])
        if not vibrates[number]:
            raise VehicleError(
                f"mode damping of {damping.name!r}: it moves freely, with no damping ratio"
            )
        if damping.damping_ratio < own - EQUAL:
            raise VehicleError(
                f"mode damping of {damping.name!r}: found {damping.damping_ratio:g}, but its bodies, "
                f"connections and mounts damp it with {own:.3g} already; give them less, or it more"
            )
        ratios[number] = damping.damping_ratio
    return ratios


def _number(damping: ModeDamping, names: list[str]) -> int:
    """The index of the mode that is meant."""
    if isinstance(damping.mode, str):
        if damping.mode not in names:
            raise VehicleError("mode damping: " + unknown("mode", damping.mode, names))
        return names.index(damping.mode)
    number = damping.mode or 0
    if not 1 <= number <= len(names):
        raise VehicleError(
            f"mode damping: found mode {number}, expected 1 to {len(names)}, the numbers of `modeviz "
            "modes`"
        )
    return number - 1
