"""Places of absorbers, which carry a mass along, as variables of a search."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from mounted_machine import mounted_machine
from test_places import (
    BAND,
    SHAKEN,
    assert_derivatives_hold,
    derivatives,
    design,
    engine,
    search_of,
)

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.optimise.goals import prepare_goal
from modeviz.study.study import Study
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorber_parts import absorbers_of
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Spring
from modeviz.vehicle.load_cases import STANDING, LoadCase
from modeviz.vehicle.loads import Force, ResponsePoint
from modeviz.vehicle.problem import (
    DeflectionLimit,
    DesignGroup,
    FrequencyWindow,
    Performance,
    Problem,
)
from modeviz.vehicle.vehicle import Vehicle

TVA = Absorber(
    "tva", "subframe", (2.6, 0.2, 0.1), 4.0, 12.0, 0.08, 0.1, ("vertical", "lateral"), (0.3, -0.2, 0.1)
)
PLACES = DesignGroup(
    "tva", (), offsets={"x": (-0.3, 0.3), "z": (-0.2, 0.1)}, angles={"x": (-0.6, 0.6), "y": (-0.5, 0.4)}
)


@cache
def on_the_engine(absorber=TVA):
    return with_absorbers(engine(), [absorber])


TWO = replace(PLACES, offsets={"x": (-0.3, 0.3)}, angles={"y": (-0.5, 0.4)})
WHICH = {"accelerations": PLACES, "purity": PLACES, "decoupling": PLACES, "change": PLACES}


@pytest.mark.parametrize(
    "goal", ["accelerations", "peak", "rms", "forces", "purity", "decoupling", "change"]
)
def test_derivatives_to_the_place_of_an_absorber_are_those_of_vehicles_made_anew(goal):
    groups = WHICH.get(goal, TWO), DesignGroup("M1")
    assert_derivatives_hold(search_of(on_the_engine(), goal, groups))


@pytest.mark.parametrize("directions", [("fore-aft",), ("vertical", "lateral", "fore-aft")])
def test_so_they_are_whatever_directions_it_has(directions):
    vehicle = on_the_engine(replace(TVA, directions=directions))
    assert_derivatives_hold(search_of(vehicle, "accelerations", (PLACES,)))


def test_so_they_are_where_its_directions_are_tuned_apart():
    vehicle = on_the_engine()
    k = vehicle.rates["tva"]
    rates = {**vehicle.rates, "tva": replace(k, lateral=2 * k.lateral)}
    assert_derivatives_hold(search_of(vehicle.with_rates(rates), "accelerations", (PLACES,)))


@cache
def on_the_beam():
    """One on a beam that bends, beside other things, at a place between its attachments."""
    machine = replace(mounted_machine(), **BAND, mode_damping=())
    return with_absorbers(machine, [replace(TVA, body="frame", position=(1.3, 0.03, 0.05), mass=9.0)])


@pytest.mark.parametrize(("goal", "step"), [("accelerations", 1e-5), ("decoupling", 2e-4)])
def test_so_they_are_on_a_body_that_bends(goal, step):
    """Squares of frequencies of a beam that bends have so much more rounding."""
    groups = (replace(PLACES, offsets={"x": (-0.1, 0.1), "y": (-0.05, 0.05)}),)
    shaken = (Performance(np.array([9.0, 21.0]), wheel_loads=("firing",)),)
    assert_derivatives_hold(search_of(on_the_beam(), goal, groups, performance=shaken), step)


def test_frequency_windows_have_derivatives_to_the_place_of_an_absorber():
    third = Study(on_the_engine()).modes()[4].name
    windows = (FrequencyWindow(third, 5.0, 25.0),)
    search = search_of(on_the_engine(), "change", (PLACES,), windows=windows, performance=())
    x = design(search)
    slopes = search.margins(x)[1]
    expected = derivatives(lambda x: search.margins(x)[0], x)
    assert (np.abs(slopes - expected).max(axis=1) < 1e-5 * np.abs(expected).max(axis=1)).all()


SLOPING = LoadCase("on a slope", np.array([0.3, -0.2, -1.0]))


@pytest.mark.parametrize("carrier", ["engine", "beam"])
def test_deflections_have_derivatives_to_the_place_of_an_absorber(carrier):
    """Where its weight goes along with it."""
    made = on_the_beam() if carrier == "beam" else on_the_engine(replace(TVA, body="engine"))
    vehicle = replace(made, load_cases=(STANDING, SLOPING))
    mount = vehicle.mounts[0].name
    limits = (
        DeflectionLimit(mount, "vertical", 0.01), DeflectionLimit("tva", "lateral", 0.01),
        DeflectionLimit(mount, "fore-aft", 0.01, "on a slope"),
        DeflectionLimit("tva", "vertical", 0.01, "on a slope"),
    )  # fmt: skip
    search = search_of(vehicle, "change", (PLACES,), deflections=limits, performance=())
    x = design(search)
    slopes = search.margins(x)[1]
    expected = derivatives(lambda x: search.margins(x)[0], x, 1e-3)
    assert (np.abs(slopes - expected).max(axis=1) < 1e-5 * np.abs(expected).max(axis=1)).all()


def test_a_design_with_an_absorber_elsewhere_is_worth_what_its_folder_is(tmp_path):
    search = search_of(on_the_engine(), "rms", (PLACES,))
    x = design(search)
    write_vehicle(search.space.built(x), tmp_path / "found")
    anew = read_vehicle(tmp_path / "found")
    problem = Problem("p", (DesignGroup("tva"),), goal="rms", performance=SHAKEN, is_normalised=False)
    there, own = (
        prepare_goal(v, problem, v.rates, 20.0).exact_value({}) for v in (anew, on_the_engine())
    )
    assert search.value(x) == pytest.approx(there / own, rel=1e-7)
    (moved,) = absorbers_of(anew)
    placed = search.space.placements(x)["tva"]
    assert moved.position == pytest.approx(np.add(TVA.position, placed.offset))


def test_an_absorber_is_moved_to_the_middle_of_what_shakes_evenly():
    """Of a bar that is shaken in its middle, seen alike at both ends: anywhere else turns it too."""
    search = search_of(bar(), "accelerations", (ALONG_THE_BAR,), performance=EVENLY)
    found = Study(bar()).optimise(Problem("p", (ALONG_THE_BAR,), performance=EVENLY), 1)
    tried = [search.value(np.array([part])) for part in np.linspace(-0.5, 0.5, 11)]
    assert found.placements["tva"].offset[0] == pytest.approx(-0.3, abs=1e-5)
    assert found.value <= min(tried) * (1 + 1e-9)
    assert found.value < 0.995


ALONG_THE_BAR = DesignGroup("tva", (), offsets={"x": (-0.6, 0.6)})
EVENLY = (Performance(np.array([8.0, 9.0, 10.0]), wheel_loads=("middle",)),)


def bar():
    """A bar on a spring at each end, with an absorber off its middle."""
    ends = [np.array([x, 0.0, 0.0]) for x in (-1.0, 1.0)]
    springs = tuple(
        Spring(
            f"spring {end[0]}", "springs", ("bar", GROUND), np.tile(end, (2, 1)), np.full(3, 2e5),
            rotational_stiffness=np.full(3, 1e5), loss_factor=0.05,
        )
        for end in ends
    )  # fmt: skip
    body = RigidBody("bar", "frame", "bar", 100.0, np.zeros(3), np.diag([5.0, 30.0, 30.0]))
    plain = Vehicle(
        "bar", (body,), springs, **BAND,
        forces=(Force("middle", "bar", np.zeros(3), np.array([0, 0, 1.0]), 10.0),),
        response_points=tuple(ResponsePoint(f"at {e[0]}", "bar", e) for e in ends),
    )  # fmt: skip
    return with_absorbers(plain, [Absorber("tva", "bar", (0.3, 0.0, 0.0), 6.0, 9.0, 0.1)])


def test_what_no_probe_tells_of_is_refused_with_a_sentence():
    vehicle = on_the_engine()
    with pytest.raises(VehicleError, match=r"at the ends of 'tva' would be felt elsewhere"):
        search_of(vehicle, "transmissibility", (PLACES,))
    seen = replace(
        vehicle, response_points=(ResponsePoint("on it", "tva mass", np.array([2.6, 0.2, 0.1])),)
    )
    with pytest.raises(VehicleError, match=r"'on it' hangs on 'tva mass'"):
        search_of(seen, "rms", (PLACES,))
