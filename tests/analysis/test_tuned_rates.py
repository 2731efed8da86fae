"""Rotational rates and dampers that are tuned, against vehicles that are made with them."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from differences import central_difference, relative_to_largest
from tuned_vehicle import OTHER, tuned_vehicle

from modeviz.analysis.driven import driven
from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare, prepare_modes
from modeviz.analysis.sensitivity import frequency_sensitivity, rate_variables
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.mount_rates import MountSprings, mount_stiffness
from modeviz.dynamics.response import direct_response
from modeviz.ride.excitation import generalised_forces
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Mount
from modeviz.vehicle.loads import BaseMotion, ResponsePoint
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

F = np.arange(1.0, 40.5, 0.5)


@cache
def prepared():
    return prepare(tuned_vehicle(), F, is_graded=False)


def exact(vehicle, name):
    """The response to a load from the matrices of a vehicle made with its rates."""
    system = assemble(vehicle)
    load = vehicle.harmonic_load(name)
    points = [system.motion(p.body, p.position)[:3] for p in vehicle.response_points]
    forces = generalised_forces(system, load, F, vehicle.speed)
    return direct_response(system, F, forces, np.vstack(points))


def test_springs_at_other_rates_are_those_of_a_vehicle_made_with_them():
    springs = MountSprings(tuned_vehicle())
    expected = mount_stiffness(tuned_vehicle().with_rates(OTHER))
    np.testing.assert_allclose(springs.stiffness(OTHER), expected, rtol=1e-15)


@pytest.mark.parametrize("load", ["shaker", "floor"])
@pytest.mark.parametrize("rates", [{}, OTHER, {"S": MountRates(0, 0, 0)}], ids=str)
def test_responses_at_other_rates_are_those_of_a_direct_solve(load, rates):
    drive = driven(prepared(), [prepared().vehicle.harmonic_load(load)], 20.0)
    found = drive.response(prepared().mount_stiffness(rates), F)
    expected = exact(tuned_vehicle().with_rates(rates), load)
    error = np.abs(found - expected).max(axis=(1, 2)) / np.abs(expected).max(axis=(1, 2))
    assert error.max() < 1e-9


def test_modes_do_not_see_dampers_and_see_rotational_rates():
    for method in ("enriched", "exact"):
        found = solve_modal(prepare_modes(tuned_vehicle()), OTHER, method)
        vehicle = tuned_vehicle().with_rates(OTHER)
        expected = solve_modes(assemble(vehicle), below_hz=40.0)
        np.testing.assert_allclose(found.modes.frequency_hz, expected.frequency_hz, rtol=1e-9)
        np.testing.assert_allclose(found.modes.damping_ratio, expected.damping_ratio, rtol=1e-7)


def variables_of(vehicle):
    """The groups and fields of its rates, and where derivatives are taken: at their own rates."""
    return [(v.group, v.direction) for v in rate_variables(vehicle)]


def differences(function, rates):
    """The derivatives of a function of rates to each that is tuned."""
    return np.array(
        [
            central_difference(
                lambda k, g=g, f=f: function({**rates, g: replace(rates[g], **{f: k})}),
                getattr(rates[g], f),
                step=1e-3,
            )
            for g, f in variables_of(tuned_vehicle())
        ]
    )


def test_variables_are_the_tuned_rates_of_every_group():
    assert variables_of(tuned_vehicle()) == [
        *(("E", f) for f in ("vertical", "lateral", "fore_aft", "rx", "ry", "rz")),
        *(("E", f) for f in ("damping_vertical", "damping_lateral")),
        *(("F", f) for f in ("vertical", "lateral", "fore_aft", "damping_fore_aft")),
        *(("S", f) for f in ("damping_vertical", "damping_lateral")),
    ]


def test_frequency_sensitivities_are_finite_differences():
    modal, rates = prepare_modes(tuned_vehicle()), tuned_vehicle().rates
    found = frequency_sensitivity(solve_modal(modal, rates)).T
    expected = differences(lambda r: solve_modal(modal, r).modes.frequency_hz, rates)
    dampers = ["damping" in field for _, field in variables_of(tuned_vehicle())]
    assert not found[dampers].any()
    springs = np.logical_not(dampers)
    assert relative_to_largest(found[springs], expected[springs], over=1).max() < 1e-5


@pytest.mark.parametrize("c", [0.0, 150.0, 900.0])
def test_a_block_on_a_spring_and_a_tuned_damper_moves_as_the_closed_form_says(c):
    m, k, own = 50.0, 2e5, MountRates(2e5, 1e5, 1e5, damping_vertical=300.0)
    bounds = MountRates(1e4, 1e4, 1e4), MountRates(1e6, 1e6, 1e6, damping_vertical=3000.0)
    block = RigidBody("block", "other", "block", m, np.zeros(3), np.eye(3))
    mount = Mount(
        "mount", "M", ("block", GROUND), np.zeros((2, 3)), rotational_stiffness=np.full(3, 1e4)
    )
    vehicle = Vehicle(
        "block", (block,), (), (MountGroup("M", "M", own, 0.0, bounds, (mount,)),),
        response_points=(ResponsePoint("seat", "block", np.zeros(3)),),
        base_motions=(BaseMotion("floor", np.array([0.0, 0.0, 1.0]), "displacement", 1e-3),),
    )  # fmt: skip
    drive = driven(prepare(vehicle, F, is_graded=False), vehicle.harmonic_loads, 20.0)
    rates = {"M": replace(own, damping_vertical=c)}
    found = drive.response(drive.prepared.mount_stiffness(rates), F)[:, 2, 0]
    omega = 2 * np.pi * F
    expected = 1e-3 * (k + 1j * omega * c) / (k + 1j * omega * c - m * omega**2)
    np.testing.assert_allclose(found, expected, rtol=1e-9)
