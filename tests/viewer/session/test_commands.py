"""What every command makes of a state, without a session."""

from dataclasses import fields, replace

import pytest
from every_command import DECISIONS, LOOKS, ON_THE_WAY, RATES, VEHICLE
from session_commands import altered

from modeviz.analysis.results import Conditions
from modeviz.errors import VehicleError
from modeviz.viewer.session.commands import decisions, looks
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.state import first_state

SOFT = VEHICLE.all_rates(VEHICLE.rate_sets["soft"])


@pytest.fixture
def state():
    return first_state(VEHICLE, VEHICLE.rates, Conditions("flat", 20.0))


def done(state, *commands):
    for command in commands:
        state = command.apply(state, VEHICLE)
    return state


def name_of(command):
    return type(command).__name__


@pytest.mark.parametrize("command", DECISIONS, ids=name_of)
def test_a_decision_changes_the_design(state, command):
    assert done(state, command).design != state.design


@pytest.mark.parametrize("command", LOOKS, ids=name_of)
def test_a_look_changes_all_that_it_names_and_leaves_the_design(state, command):
    after = done(state, command)
    assert after != state
    assert after.design == state.design
    named = {field.name: getattr(command, field.name) for field in fields(command)}
    is_known = name_of(command).startswith(("Change", "Drive", "LookAt"))
    known = {n: v for n, v in named.items() if is_known and v is not None}
    parts = (after.motion, after.charts, after.look, after.rigid, after.engine, after.conditions)
    assert known.items() <= {n: v for part in parts for n, v in vars(part).items()}.items()


def test_every_command_is_tried_here():
    tried = {name_of(command) for command in (*DECISIONS, *LOOKS, *ON_THE_WAY)}
    modules = (decisions, looks)
    there = {
        n for m in modules for n, v in vars(m).items() if isinstance(v, type) and issubclass(v, Command)
    }
    assert there - {"Command"} == tried


def test_a_rate_and_a_loss_factor_select_their_group(state):
    for command in (decisions.SetRate("B", "lateral", 1e5), decisions.SetLossFactor("B", 0.3)):
        assert done(state, command).group == "B"


def test_a_loss_factor_that_is_the_groups_own_is_none_of_its_own(state):
    damped = done(state, decisions.SetLossFactor("A", 0.3))
    assert damped.design.rates["A"].loss_factor == 0.3
    own = VEHICLE.mount_group("A").loss_factor_with(VEHICLE.rates["A"])
    assert done(damped, decisions.SetLossFactor("A", own)).design == state.design


def test_to_reset_goes_to_the_set_compared_with_and_leaves_what_is_locked(state):
    moved = done(
        state,
        decisions.TakeRates({"A": RATES, "B": RATES}),
        decisions.ToggleLock("A", "vertical"),
        looks.CompareWith("Soft"),
    )
    one = done(moved, decisions.ResetRate("A", "lateral")).design.rates
    assert one == {"A": replace(RATES, lateral=SOFT["A"].lateral), "B": RATES}
    group = done(moved, decisions.ResetGroups(("A",))).design.rates
    assert group == {"A": replace(SOFT["A"], vertical=RATES.vertical), "B": RATES}


def test_what_is_called_otherwise_is_compared_and_drawn_under_its_new_name(state):
    there = done(
        state,
        decisions.Pin("Mine"),
        looks.CompareWith("Mine"),
        looks.Overlay("Mine", True),
        decisions.Rename("Mine", "Yours"),
    )
    assert list(there.design.variants) == ["Yours"]
    assert (there.against, there.charts.overlaid) == ("Yours", {"Yours"})
    gone = done(there, decisions.Forget("Yours"))
    assert (gone.against, gone.charts.overlaid) == ("Original", frozenset())


@pytest.mark.parametrize(
    "command",
    [
        decisions.Pin("Original"),
        decisions.Forget("Soft"),
        decisions.Load("Nothing"),
        decisions.Rename("Nothing", "Something"),
        decisions.AddVariant("Soft", VEHICLE.rate_sets["soft"]),
        looks.CompareWith("Nothing"),
        looks.Overlay("Nothing", True),
    ],
)
def test_what_there_is_not_or_is_the_vehicles_own_is_left_alone(state, command):
    assert done(state, command) == state


@pytest.mark.parametrize(
    "command",
    [
        decisions.SetRate("Z", "lateral", 1e5),
        decisions.SetLossFactor("Z", 0.1),
        decisions.TakeRates({"Z": RATES}),
        decisions.LinkRates("Z", True),
        decisions.ToggleLock("Z", "lateral"),
        decisions.ResetRate("Z", "lateral"),
        looks.SelectGroup("Z"),
        looks.ShowBody("Z", True),
        looks.Drive(road="Z"),
    ],
    ids=name_of,
)
def test_what_the_vehicle_does_not_have_is_refused(state, command):
    with pytest.raises(VehicleError, match=r"unknown .*'Z'"):
        done(state, command)


@pytest.mark.parametrize("before", ["none", "rest"])
def test_outlines_of_the_compared_set_give_way_to_those_before(state, before):
    compared = done(
        altered(state, ghost=before), looks.ShowGhost("compared"), looks.ShowGhost("compared")
    )
    assert compared.look.ghost == "compared"
    assert done(compared, looks.ShowComparedGhost(False)).look.ghost == before


def test_a_mode_is_shown_where_something_else_moved_but_stays_damped(state):
    for kind, then in (("component", "mode"), ("damped mode", "damped mode")):
        shown = done(altered(state, kind=kind), looks.ShowMode("cab roll"))
        assert (shown.motion.mode, shown.motion.kind) == ("cab roll", then)


def test_a_drag_is_one_step_of_its_rate_alone():
    drag = [decisions.SetRate("A", "lateral", rate).step for rate in (1e5, 2e5)]
    assert drag[0] == drag[1] is not None
    assert decisions.SetRate("A", "vertical", 1e5).step != drag[0]
    assert decisions.Swap().step is None
