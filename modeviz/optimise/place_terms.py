"""What placing mounts otherwise does to goals and limits that read the mounts themselves.

Beside what it does by the vehicle's stiffness: their own stretch, or the motion of their ends, is then
read elsewhere, all else as it is.
"""

import numpy as np

from modeviz.dynamics.mount_rates import by_motion
from modeviz.optimise.deflections import Deflections
from modeviz.optimise.goals import Goal, LeastChange
from modeviz.optimise.mount_goals import (
    MountCase,
    MountForceGoal,
    TransmissibilityGoal,
    passed_on,
)
from modeviz.optimise.probes import Probes
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates


def goal_term(goal: Goal, rates: Rates, probes: Probes) -> Floats:
    """Return what a goal changes by its mounts being read elsewhere, (n_places,), per m or rad.

    Args:
        goal: of the vehicle with its probes.
        rates: of the groups that differ from the vehicle's own.
        probes: about its mounts.
    """
    if not probes.places.variables:
        return np.zeros(0)
    match goal:
        case MountForceGoal():
            return np.sum([_force_term(case, rates, probes) for case in goal.cases], axis=0)
        case TransmissibilityGoal():
            return np.sum([_ratio_term(goal, case, rates, probes) for case in goal.cases], axis=0)
        case _:
            return np.zeros(len(probes.places.variables))


def change_of(goal: Goal, moved: Floats) -> tuple[float, Floats]:
    """Return what moves add to the goal of least change, as rates do, and derivatives, (n_places,).

    Args:
        goal: any; to others they add nothing.
        moved: (n_places,), parts of the widths of bounds.
    """
    n = goal.n_rates if isinstance(goal, LeastChange) else np.inf
    return float(moved @ moved) / n, 2 * moved / n


def margin_terms(limits: Deflections, by_rate: Floats, rates: Rates, probes: Probes) -> Floats:
    """Return the derivatives of margins of deflections, (n_limits, n_places), per m or rad.

    A spring has the force k c'(d) d + f₀ on the straight part of its curve on which it is. The first
    part is that of a straight spring, of which probes tell; f₀ pulls along where the spring is then,
    which is linear in its rows, as is what is read of the limited mount itself. Weights that go along
    pull where they are.

    Args:
        limits: of the vehicle with its probes.
        by_rate: derivatives of the margins to rates, (n_limits, n_rates), those of probes last.
        rates: of the groups that differ from the vehicle's own.
        probes: about its mounts.
    """
    n_mounts, n_probes, n_places = probes.slopes.shape
    terms = np.zeros((len(by_rate), n_places))
    if not n_places:
        return terms
    along = slice(3 * n_mounts, 3 * (n_mounts + n_probes))
    settling = limits.prepared.settling(rates)
    axes = [mount.axes for mount in limits.prepared.vehicle.mounts[n_mounts:]]
    each = zip(terms, by_rate, limits.limits, limits.stretched(rates), strict=True)
    for term, own, limit, (spring, d) in each:
        mount, axis = divmod(spring, 3)
        tangents = settling.laws.tangent(d)
        slope = -np.sign(d[spring]) / limit.most
        by_place = probes.by_place(rates, tangents)
        f0 = settling.laws.force(settling.stiffness, d) - settling.stiffness * tangents * d
        moved = settling.compliance(d)[spring, along].reshape(n_probes, 3)
        read = np.einsum("p,pv->v", d[along].reshape(n_probes, 3)[:, axis], probes.slopes[mount])
        pulled = np.einsum("ma,pa,mpv->v", f0[: along.start].reshape(-1, 3), moved, probes.slopes)
        term += own[-len(by_place) :] @ by_place + slope * (read - pulled)
        gravity = limits.gravity(limit.load_case)
        for probe, turned, motion in zip(probes.probes, axes, moved, strict=True):
            term[probe.number] += slope * float(motion @ probe.pull(turned @ gravity))
    return terms


def _force_term(case: MountCase, rates: Rates, probes: Probes) -> Floats:
    """Σ w |z_i|² ∂|x_i|²/∂p of the mounts that count, z of a spring and the damper beside it."""
    n_mounts, n_probes, n_places = probes.squares.shape
    counts, found = case.weight * case.selected[:n_mounts], np.zeros(n_places)
    for passed in passed_on(case, rates):
        z = by_motion(case.driven.prepared.vehicle, passed.stiffness)
        own = np.square(np.abs(z)).reshape(len(z), -1, 6)[:, :n_mounts, :3]
        along = passed.stretched[:, 3 * n_mounts : 3 * (n_mounts + n_probes)].reshape(-1, n_probes, 3)
        read = np.einsum("fia,fpa->iap", own, along, optimize=True)
        found += np.einsum("ia,iap,ipv->v", counts, read, probes.squares)
    return found


def _ratio_term(goal: TransmissibilityGoal, case: MountCase, rates: Rates, probes: Probes) -> Floats:
    """W (∂a₂² - a₂²/a₁² ∂a₁²) / a₁², both summed over the mounts that count."""
    n_mounts = len(probes.squares)
    ends, counts = goal.mean_squares(case, rates), case.selected[:n_mounts]
    below, above = np.einsum("ia,eia->e", counts, ends[:, :n_mounts])
    below_term, above_term = np.einsum("ia,epa,ipv->ev", counts, ends[:, n_mounts:], probes.squares)
    return case.weight * (above_term - above / below * below_term) / below
