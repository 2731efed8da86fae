"""The truck's truncated components against its full finite-element model, 41 454 degrees of freedom."""

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from builtin_truck import builtin_truck
from pickup.full_model import FullModel, FullModes, full_model, full_vehicle_modes
from pickup.parameters import Parameters

from modeviz.dynamics.assembly import System, assemble
from modeviz.dynamics.modes import Modes, solve_modes
from modeviz.dynamics.truncation import modes_only
from modeviz.vehicle.bodies import FlexibleBody

BAND_HZ = 20.0
N_MODES = 30
RATES = "original", "optimised"
README = Path(__file__).parents[2] / "README.md"


@dataclass(frozen=True)
class Case:
    model: FullModel
    full: FullModes
    truncated: System
    paper: System
    """Modes alone, with residual compliance at the bolts."""


@pytest.fixture(scope="module", params=RATES)
def case(request):
    return case_of(request.param)


@cache
def case_of(rates: str) -> Case:
    vehicle = builtin_truck()
    vehicle = vehicle.with_rates(vehicle.rate_sets[rates])
    model = full_model(vehicle, Parameters())
    return Case(
        model,
        full_vehicle_modes(model, N_MODES),
        assemble(vehicle),
        assemble(modes_only(vehicle)),
    )


def node_motion(case: Case, system: System, modes: Modes):
    """The truncated modes in the degrees of freedom of the full model, (n_dofs, n_modes)."""
    shapes = np.zeros((len(case.full.shapes), modes.shapes.shape[1]))
    for body in system.vehicle.bodies:
        own = modes.shapes[system.dofs[body.name]]
        if isinstance(body, FlexibleBody):
            own = body.shapes.reshape(-1, body.n_modes).astype(float) @ own
        shapes[case.model.dofs[body.name]] = own
    return shapes


def paired_frequencies(case: Case, system: System):
    """Frequencies of the full model's modes in the band and of the modes whose shapes are theirs."""
    modes = solve_modes(system, N_MODES)
    phi = node_motion(case, system, modes)
    M = case.model.mass
    cross = case.full.shapes.T @ (M @ phi)
    likeness = cross**2 / np.einsum("ij,ij->j", phi, M @ phi)  # MAC; the full shapes have unit mass
    in_band = (case.full.frequency_hz > 0.1) & (case.full.frequency_hz < BAND_HZ)
    best = likeness.argmax(axis=1)[in_band]
    assert len(set(best)) == in_band.sum()
    return case.full.frequency_hz[in_band], modes.frequency_hz[best], likeness.max(axis=1)[in_band]


@pytest.mark.slow
def test_the_full_model_has_every_degree_of_freedom(case):
    assert len(case.full.shapes) == 41454
    assert case.truncated.n_dofs < 450


@pytest.mark.slow
def test_every_mode_below_20_hz_is_within_0_005_percent_of_the_full_model(case):
    full, truncated, likeness = paired_frequencies(case, case.truncated)
    assert len(full) >= 23
    assert likeness.min() > 0.999
    np.testing.assert_allclose(truncated, full, rtol=5e-5)


@pytest.mark.slow
def test_the_papers_modes_alone_are_as_far_off_as_the_readme_says():
    """How far depends on the truck: nothing bounds it, so what is said of it is held."""
    claim = r"`dynamics\.truncation\.modes_only`\), is up to ([\d.]+) % off"
    (said,) = re.findall(claim, README.read_text())
    pairs = (paired_frequencies(case, case.paper)[:2] for case in map(case_of, RATES))
    worst = max(np.abs(paper / full - 1).max() for full, paper in pairs)
    assert 100 * worst == pytest.approx(float(said), abs=0.051)
