"""Where energy is turned into heat: in the rubber and dampers of connections, and in bending bodies.

A spring k (1 + jg) beside a damper c that is stretched by δ cos ωt loses π (gk + ωc) δ² in a cycle, the
mean power ½ ω (gk + ωc) δ² (D. J. Inman, "Engineering Vibration", section 2.7); under a random load it
is ∫ ω (gk + ωc) S_δδ df.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.assembly import System, modal_coefficients
from modeviz.dynamics.mount_rates import by_motion, constant_damping
from modeviz.mounting.forces import N_MOTIONS, Forces, connection_rates
from modeviz.mounting.free_bodies import body_motions
from modeviz.mounting.levels import InputSpectra
from modeviz.mounting.paths import MODE_DAMPING
from modeviz.vehicle.arrays import Array, Complexes, Floats
from modeviz.vehicle.bodies import FlexibleBody


@dataclass(frozen=True, eq=False)
class Dissipation:
    """What is turned into heat under a load, and what comes in."""

    frequency_hz: Floats
    """(n_freqs,)."""
    by_place: Mapping[str, Floats]
    """(n_freqs,) by the name of a connection, of a flexible body or `MODE_DAMPING`.

    Under a random load the power's spectrum, W/Hz; under a harmonic one the mean power, W."""
    work: Floats
    """(n_freqs,): what loads and the moving ground put in, in the same units."""
    power: Mapping[str, float]
    """The power of each place over all lines under a random load, W; nothing under a harmonic one."""


def dissipation(forces: Forces, spectra: InputSpectra, is_random: bool) -> Dissipation:
    """The energy that a vehicle loses under a load.

    Args:
        forces: of its connections.
        spectra: of the load's inputs.
        is_random: whether it has a spectrum; else its amplitude is a peak.
    """
    omega = forces.omega[:, None]
    x = body_motions(forces.system, forces.frequency_hz, forces.on_bodies)
    half = 1.0 if is_random else 0.5
    losses = _losses(forces, x)
    by_place = {
        name: half * (omega * factor * spectra.psd(motion)).sum(axis=1)
        for name, (factor, motion) in losses.items()
    }
    power = {
        name: float(spectra.total(motion, motion, omega * factor).sum())
        for name, (factor, motion) in losses.items()
    }
    return Dissipation(
        forces.frequency_hz,
        by_place,
        half * _work(forces, x, spectra),
        power if is_random else {},
    )


def _losses(forces: Forces, x: Complexes) -> dict[str, tuple[Floats, Complexes]]:
    """What resists motions in phase with their speed, (n_freqs, n), and these motions, by place."""
    system, omega = forces.system, forces.omega
    z = connection_rates(system, omega).imag
    losses = {}
    for i, connection in enumerate(forces.connections):
        own = slice(N_MOTIONS * i, N_MOTIONS * (i + 1))
        if z[:, own].any():
            losses[connection.name] = z[:, own], forces.stretch[:, own]
    for body in system.vehicle.bodies:
        if isinstance(body, FlexibleBody):
            damping, _, structural = modal_coefficients(body)
            losses[body.name] = structural + omega[:, None] * damping, x[:, system.dofs[body.name]]
    if len(system.mode_damping):
        losses[MODE_DAMPING] = np.outer(omega, system.mode_damping), system.mode_dampers @ x
    return losses


def _work(forces: Forces, x: Complexes, spectra: InputSpectra) -> Floats:
    """ω Im of the loads times the motions they act on, (n_freqs,).

    The ground moves with g against the force F that connections put on it.
    """
    omega = forces.omega[:, None]
    by_loads = spectra.cross(-1j * forces.loads, x)
    by_ground = spectra.cross(1j * forces.force, forces.ground)
    return (omega * by_loads).sum(axis=1) + (omega * by_ground).sum(axis=1)


def dissipated_energy(
    system: System, shapes: Array, frequency_hz: Floats, mount_stiffness: Complexes | None = None
) -> dict[str, Floats]:
    """The share of each connection group and flexible body in what a mode loses in a cycle.

    Of shapes that move with their natural frequency, (gk + ωc) δ² of each spring and damper over all; a
    mode that loses nothing has no shares: zeros. Complex shapes are taken as they are.

    Args:
        system: what vibrates.
        shapes: (n_dofs, n_modes).
        frequency_hz: (n_modes,).
        mount_stiffness: complex rates of every mount spring there, (n_modes or 1, n_springs), jωc of
            dampers, in place of its own.

    Returns:
        (n_modes,) by name.
    """
    omega, vehicle = 2 * np.pi * np.asarray(frequency_hz), system.vehicle
    z = _loss(system, omega, mount_stiffness)
    lost = z.T * np.abs(system.connection_motions @ shapes) ** 2
    by_name: dict[str, Floats] = {}
    for i, connection in enumerate(vehicle.all_connections):
        own = lost[N_MOTIONS * i : N_MOTIONS * (i + 1)].sum(axis=0)
        by_name[connection.group] = by_name.get(connection.group, 0.0) + own
    for body in vehicle.bodies:
        if isinstance(body, FlexibleBody):
            damping, _, structural = modal_coefficients(body)
            factor = structural[:, None] + np.outer(damping, omega)
            by_name[body.name] = (factor * np.abs(shapes[system.dofs[body.name]]) ** 2).sum(axis=0)
    if len(system.mode_damping):
        moved = np.abs(system.mode_dampers @ shapes) ** 2
        by_name[MODE_DAMPING] = omega * (system.mode_damping @ moved)
    total = np.sum(list(by_name.values()), axis=0)
    return {
        name: np.divide(e, total, out=np.zeros_like(e), where=total > 0) for name, e in by_name.items()
    }


def _loss(system: System, omega: Floats, mount_stiffness: Complexes | None) -> Floats:
    """The loss gk + ωc of every motion of connections, (n_modes, 6 n_connections)."""
    z = np.array(connection_rates(system, omega).imag, np.float64)
    if mount_stiffness is None:
        return z
    of_springs = by_motion(system.vehicle, mount_stiffness.imag)
    n = of_springs.shape[1]
    z[:, :n] = np.multiply.outer(omega, constant_damping(system.vehicle)[:n]) + of_springs
    return z
