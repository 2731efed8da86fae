"""Searches that keep mounts from giving more than they may, against hand-solved designs."""

from dataclasses import replace

import numpy as np
import pytest
from differences import rate_derivatives
from engine_on_mounts import engine_on_mounts
from progressive_block import MASS, progressive_block

from modeviz.errors import SolveError, VehicleError
from modeviz.optimise.deflections import MARGIN, prepare_deflections
from modeviz.optimise.outside import outside_search
from modeviz.optimise.run import optimise
from modeviz.optimise.search import prepare_search
from modeviz.report.optimum import optimum_table
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DeflectionLimit, DesignGroup, Problem

WEIGHT = MASS * STANDARD_GRAVITY
ENGINE_LIMITS = (
    DeflectionLimit("M3", "vertical", 0.0012),
    DeflectionLimit("M1", "lateral", 0.0012, "cornering left 1 g"),
    DeflectionLimit("M2", "fore-aft", 0.002, "braking 1 g"),
)


def problem_of(*limits: DeflectionLimit) -> Problem:
    """As little change of the vertical rate as keeps to limits."""
    return Problem(
        "stiff enough", (DesignGroup("m", ("vertical",)),), goal="change", deflections=limits
    )


def search_for(vehicle, *limits):
    return prepare_search(vehicle, problem_of(*limits), vehicle.rates, 20.0)


def test_margins_are_parts_of_the_limits():
    margins, _ = prepare_deflections(engine_on_mounts(), ENGINE_LIMITS).margins({})
    # ../shared/cases/powertrain/README.md: 508.130 N on 320 N/mm
    assert margins[0] == pytest.approx(1 - 508.130 / 320e3 / 0.0012 - MARGIN, abs=3e-6)


@pytest.mark.parametrize("factor", [0.6, 1.5])
def test_derivatives_of_margins_are_central_differences(factor):
    engine = engine_on_mounts()
    deflections = prepare_deflections(engine, ENGINE_LIMITS)
    rates = {n: MountRates(*(factor * k for k in r.as_tuple())) for n, r in engine.rates.items()}
    _, gradients = deflections.margins(rates)
    expected = rate_derivatives(lambda r: deflections.margins(r)[0], rates).T
    scale = np.abs(expected).max(axis=1, keepdims=True)
    assert (np.abs(gradients - expected) < 1e-7 * scale).all()


@pytest.mark.parametrize("factor", [1.0, 1.9, 3.0])
def test_derivatives_on_progressive_mounts_are_central_differences(factor):
    vehicle = progressive_block()
    deflections = prepare_deflections(vehicle, [DeflectionLimit("m", "vertical", 0.005)])
    rates = {"m": MountRates(1.3e5 * factor, 1e6, 1e6)}
    _, gradients = deflections.margins(rates)
    expected = rate_derivatives(lambda r: deflections.margins(r)[0], rates).T
    assert gradients[0, 0] == pytest.approx(expected[0, 0], rel=1e-6)


@pytest.mark.parametrize(
    ("curves", "most", "expected"),
    [
        ({}, 0.005, 1.3 * WEIGHT / 0.005),
        (None, 0.006, 1.3e5 * WEIGHT / 800.0),  # its curve has 800 N at 6 mm
    ],
)
def test_the_least_change_is_the_design_that_just_gives_so_much(curves, most, expected):
    vehicle = progressive_block(curves=curves)
    search = search_for(vehicle, DeflectionLimit("m", "vertical", most))
    found = optimise(search, [np.zeros(1)])
    assert found.rates["m"].vertical == pytest.approx(expected, rel=1e-4)
    assert found.verification.are_kept
    assert found.verification.deflection == pytest.approx([-most], rel=1e-4)
    assert [limit.name for limit in found.active] == [
        f"m vertical: at most {1e3 * most:g} mm in standing"
    ]
    assert f"m gives {1e3 * most:.3f} mm (vertical, standing)" in optimum_table(
        problem_of(search.deflections.limits[0]), search, found
    )


def test_a_mount_that_gives_little_enough_stays_as_it_is():
    vehicle = progressive_block(curves={})
    search = search_for(vehicle, DeflectionLimit("m", "vertical", 0.011))
    found = optimise(search, [np.zeros(1)])
    assert found.rates["m"].vertical == pytest.approx(1.3e5, rel=1e-6)
    assert found.active == ()


def test_limits_that_no_design_keeps_are_told():
    vehicle = progressive_block(curves={})
    search = search_for(vehicle, DeflectionLimit("m", "vertical", 1e-4))
    words = r"keeps the limits of deflections \(m vertical: at most 0.1 mm in standing\)"
    with pytest.raises(SolveError, match=words):
        optimise(search, [np.zeros(1)])


def test_rates_that_give_more_are_told_to_be_outside():
    vehicle = progressive_block(curves={})
    search = search_for(vehicle, DeflectionLimit("m", "vertical", 0.005))
    assert outside_search(search, vehicle.rates) == (
        "m gives 9.81 mm (vertical, standing), may give 5 mm",
    )
    assert outside_search(search, {"m": MountRates(3e5, 1e6, 1e6)}) == ()


@pytest.mark.parametrize(
    ("limit", "words"),
    [
        (DeflectionLimit("n", "vertical", 0.005), "unknown mount 'n': there are m"),
        (DeflectionLimit("m", "vertical", 0.005, "bmp"), "unknown load case 'bmp'"),
    ],
)
def test_limits_of_what_is_not_there_are_refused(limit, words):
    vehicle = progressive_block()
    with pytest.raises(VehicleError, match=words):
        replace(vehicle, problems=(problem_of(limit),))


def test_a_limit_is_above_zero_along_a_direction():
    with pytest.raises(VehicleError, match="deflection of 'm': most: found 0 m, expected more"):
        DeflectionLimit("m", "vertical", 0.0)
    with pytest.raises(VehicleError, match="deflection of 'm': unknown direction 'down'"):
        DeflectionLimit("m", "down", 0.01)
