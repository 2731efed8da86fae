"""States as text: back as they were, and refused when a stranger wrote them."""

import dataclasses
import json
import random
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from types import NoneType
from typing import Literal, get_args, get_origin, get_type_hints

import numpy as np
import pytest
from every_command import ABSORBERS, DECISIONS, LOOKS, ON_THE_WAY, VEHICLE
from session_commands import Listener

from modeviz.analysis.results import Conditions
from modeviz.errors import LONGEST, ModevizError, VehicleError
from modeviz.files.schema.hints import alternatives
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.decoupling import Decoupling
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.session.commands import absorbers, decisions, looks
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.encoding.fit_design import outside_bounds
from modeviz.viewer.session.encoding.fitting import check_fits, fitted
from modeviz.viewer.session.encoding.plain import plain_of
from modeviz.viewer.session.encoding.text import VERSION, text_of, value_of_text
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import Charts, ForceCurve, ResponseCurve, State, first_state

FIRST = first_state(VEHICLE, VEHICLE.rates, Conditions("flat", 20.0))


def read(text):
    return value_of_text(text, State, "state")


def states():
    """Those of a session that is given every command, one after the other."""
    state, found = FIRST, [FIRST]
    for command in (*DECISIONS, *LOOKS, *ON_THE_WAY, *ABSORBERS):
        vehicle = with_absorbers(VEHICLE, state.design.alterations.absorbers)
        before, state = state, command.apply(state, vehicle)
        if state.design.alterations != before.design.alterations:
            vehicle = with_absorbers(VEHICLE, state.design.alterations.absorbers)
            state = state.with_known_parts(before.design, vehicle)
        found.append(state)
    return found


STATES = states()
FULLEST = max(STATES, key=lambda state: len(text_of(state)))


def test_every_command_is_tried_here():
    tried = {type(command) for command in (*DECISIONS, *LOOKS, *ON_THE_WAY, *ABSORBERS)}
    modules = absorbers, decisions, looks
    there = {each for module in modules for each in vars(module).values() if isinstance(each, type)}
    assert {each for each in there if issubclass(each, Command)} - {Command} == tried


@pytest.mark.parametrize("state", STATES)
def test_what_every_command_makes_comes_back_as_it_was_and_fits(state):
    again = read(text_of(state))
    assert again == state
    assert plain_of(again) == plain_of(state)  # fields that do not count when states are compared too
    assert text_of(again) == text_of(state)
    check_fits(again, FIRST, VEHICLE, "state")


@pytest.mark.parametrize("seed", range(4))
def test_whatever_is_done_the_state_of_a_session_fits_its_vehicle(seed):
    """Else a link to what somebody sees would be refused."""
    rng = random.Random(seed)
    session = Session(VEHICLE, FIRST, Listener())
    commands = [*DECISIONS, *LOOKS, *ON_THE_WAY, *ABSORBERS]
    of_roof = [looks.ChooseCurve(0, ForceCurve("roof", "z")), looks.ShowBody("roof mass", False),
               looks.LookAtEngine(curve=ForceCurve("roof", "z")), looks.SelectGroup("roof"),
               decisions.ToggleLock("roof", "vertical"), decisions.Pin("With roof")]  # fmt: skip
    for _ in range(60):
        has_roof = bool(session.state.design.alterations.absorbers)
        command = rng.choice(commands + of_roof * 2 if has_roof else commands)
        with suppress(VehicleError):  # an absorber that is there, or is not
            session.do(command)
        if rng.random() < 0.2:
            session.undo()
        check_fits(session.state, FIRST, VEHICLE, "state")
    session.close()


def anything(hint, rng):
    """A random value of a type, as far as its own checks allow."""
    kinds = alternatives(hint)
    if NoneType in get_args(hint) and rng.random() < 0.3:
        return None
    kind = rng.choice(kinds)
    if kind is Decoupling:
        return Decoupling(rng.uniform(0.1, 1), rng.uniform(0, 9), rng.uniform(10, 90))
    if kind is Absorber:
        place = tuple(rng.gauss(0, 1) for _ in range(3))
        return Absorber(anything(str, rng), "cab", place, rng.uniform(0.1, 9), rng.uniform(1, 50))
    if dataclasses.is_dataclass(kind):
        hints = get_type_hints(kind)
        return kind(**{f.name: anything(hints[f.name], rng) for f in dataclasses.fields(kind)})
    inner = get_args(kind)
    match get_origin(kind) or kind:
        case stem if stem is Literal:
            return rng.choice(inner)
        case stem if stem is Mapping:
            return {anything(inner[0], rng): anything(inner[1], rng) for _ in range(rng.randrange(4))}
        case stem if stem is frozenset:
            return frozenset(anything(inner[0], rng) for _ in range(rng.randrange(4)))
        case stem if stem is tuple:
            every = [inner[0]] * rng.randrange(4) if inner[-1] is Ellipsis else inner
            return tuple(anything(each, rng) for each in every)
        case stem if stem is bool:
            return rng.random() < 0.5
        case stem if stem is int:
            return rng.randrange(10**9)
        case stem if stem is float:
            return rng.choice([1e-300, 0.1, 1 / 3, 5e-324, 2.0**53 + 2, 1e99]) * (1 + rng.random())
        case stem if stem is str:
            return "".join(
                rng.choice('aß°€\U0001f600"\\\n\0\x7f\u2028 ') for _ in range(rng.randrange(9))
            )
    raise AssertionError(f"no value of {kind} is known: write one here")


@pytest.mark.parametrize("seed", range(60))
def test_any_state_comes_back_exactly_whatever_fields_it_has(seed):
    """Made of the hints of all fields: one that is new is tried too, or is told here."""
    state = anything(State, random.Random(seed))
    again = read(text_of(state))
    assert again == state
    assert plain_of(again) == plain_of(state)


def leaves(data, path=()):
    """The paths of all that is no table or list, or an empty one."""
    items = (
        data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    )
    for key, value in items:
        yield from leaves(value, (*path, key))
    if not isinstance(data, dict | list) or not data:
        yield path


def put(data, path, value):
    """A copy with another value at a path."""
    if not path:
        return value
    copy = data.copy()
    copy[path[0]] = put(data[path[0]], path[1:], value)
    return copy


def at(data, path):
    for key in path:
        data = data[key]
    return data


def every_field(kind=State, seen=None):
    """(dataclass, field) of all dataclasses that a state is made of."""
    seen = set() if seen is None else seen
    if dataclasses.is_dataclass(kind) and kind not in seen:
        seen.add(kind)
        for field in dataclasses.fields(kind):
            yield kind, field
            yield from every_field(get_type_hints(kind)[field.name], seen)
    for inner in get_args(kind):
        yield from every_field(inner, seen)


def test_no_field_is_left_out_of_the_text_or_of_what_is_read():
    for kind, field in every_field():
        value = anything(kind, random.Random(1))
        assert field.name in plain_of(value)
        assert field.init, f"{kind.__name__}.{field.name} could not be given back"


def test_a_text_without_a_field_that_came_later_has_its_default():
    data = json.loads(text_of(FIRST))
    del data["content"]["classic"], data["content"]["charts"]["paths_by"]
    assert read(json.dumps(data)) == FIRST


FREE = {("motion", "mode"), ("design", "plan", "mode")}
"""What is called so is looked for in every answer, and need not be there."""


def names_in(state):
    """The paths of texts that name something, keys of tables excepted."""
    plain = plain_of(state)
    for path in leaves(plain):
        if isinstance(at(plain, path), str) and path not in FREE and path[-1] != "frequencies":
            yield path


RICH = replace(
    FULLEST,
    charts=replace(FULLEST.charts, overlaid=frozenset(["Soft"]), curves=(
        ResponseCurve(0, "lateral"), ForceCurve("A 0.5", "z"))),
    design=replace(FULLEST.design, locked=frozenset([("A", "lateral")]), linked=frozenset(["A"])),
    look=replace(FULLEST.look, hidden=frozenset(["cab"])),
)  # fmt: skip


def is_own(path):
    """Whether a text is what somebody called something."""
    return path[-1] == "name" and "absorbers" in path


@pytest.mark.parametrize("path", [*filter(lambda p: not is_own(p), names_in(RICH))], ids=str)
def test_no_name_is_believed(path):
    """Every text of a state that names something is looked up, one in a field that is new too."""
    check_fits(read(text_of(RICH)), FIRST, VEHICLE, "state")
    data = put(plain_of(RICH), path, "nobody")
    with pytest.raises(ModevizError, match=r"nobody"):
        check_fits(read(json.dumps({"version": VERSION, "content": data})), FIRST, VEHICLE, "state")


CONTENT = plain_of(RICH)
NUMBERS = [path for path in leaves(CONTENT) if type(at(CONTENT, path)) is float]


@pytest.mark.parametrize(
    "value", ["NaN", "Infinity", "-Infinity", "1e400", "1e150", "-1e150", "9" * 400]
)
def test_a_number_that_is_none_or_too_large_is_refused_wherever_it_stands(value):
    for path in NUMBERS[:: max(1, len(NUMBERS) // 20)]:
        text = json.dumps({"version": 1, "content": put(CONTENT, path, "@")}).replace('"@"', value)
        with pytest.raises(ModevizError):
            read(text)


HOSTILE = {
    "nothing": "",
    "no JSON": "{",
    "no text": b"\xff\xfe",
    "half a letter": '{"version": 1, "content": "\\ud800"}',
    "deep": "[" * 100_000,
    "deep within": json.dumps({"version": 1, "content": put(CONTENT, ("group",), "@")}).replace(
        '"@"', "[" * 900 + "]" * 900
    ),
    "long": " " * 5_000_000,
    "a list": "[]",
    "no version": json.dumps({"content": CONTENT}),
    "a strange version": json.dumps({"version": True, "content": CONTENT}),
    "a later version": json.dumps({"version": 2, "content": CONTENT}),
    "no content": json.dumps({"version": 1}),
    "another content": json.dumps({"version": 1, "content": 3}),
    "a key too many": json.dumps({"version": 1, "content": {**CONTENT, "__class__": "os.system"}}),
    "a key too few": json.dumps({"version": 1, "content": {}}),
    "a number as text": json.dumps({"version": 1, "content": put(CONTENT, NUMBERS[0], "1e5")}),
    "true as a number": json.dumps({"version": 1, "content": put(CONTENT, NUMBERS[0], True)}),
    "a negative rate": json.dumps({"version": 1, "content": put(CONTENT, NUMBERS[0], -1.0)}),
    "a long text": json.dumps({"version": 1, "content": put(CONTENT, ("against",), "x" * 5000)}),
    "a long list": json.dumps(
        {"version": 1, "content": put(CONTENT, ("look", "hidden"), ["x"] * 30_000)}
    ),
    "no curve": json.dumps({"version": 1, "content": put(CONTENT, ("charts", "curves", 0), {"a": 1})}),
    "two curves": json.dumps(
        {"version": 1, "content": put(CONTENT, ("charts", "curves", 0), {"mount": "A", "point": 1})}
    ),
}  # fmt: skip


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
def test_what_nobody_of_us_wrote_is_refused_in_a_sentence(text):
    with pytest.raises(ModevizError) as refusal:
        read(text)
    assert len(str(refusal.value)) <= LONGEST
    assert "\n" not in str(refusal.value)


def misfit(**fields):
    return replace(FIRST, **fields)


def designed(**fields):
    return misfit(design=replace(FIRST.design, **fields))


PLAN = FIRST.design.plan
VARIANT = decisions.Pin("Mine").apply(FIRST, VEHICLE).design.variants["Mine"]
MISFITS = {
    "too stiff": (designed(rates={**FIRST.design.rates, "A": MountRates(2e9, 1, 1)}), "vertical rate"),
    "a rate that is not tuned": (
        designed(rates={**FIRST.design.rates, "A": MountRates(1, 1, 1, rx=1.0)}),
        "not tuned",
    ),
    "too lossy": (designed(rates={**FIRST.design.rates, "A": MountRates(1, 1, 1, 99.0)}), "loss"),
    "no rates": (designed(rates={}), "came later"),
    "too many variants": (
        designed(variants={f"v{i}": replace(VARIANT, number=i) for i in range(501)}),
        "501 variants, expected at most 500",
    ),
    "too long a name": (designed(variants={"x" * 201: VARIANT}), "201 letters"),
    "no name": (designed(variants={"": VARIANT}), "0 letters"),
    "a name of the vehicle's": (designed(variants={"Soft": VARIANT}), "Soft 2"),
    "one number twice": (designed(variants={"a": VARIANT, "b": VARIANT}), "another colour"),
    "a rate of no group": (designed(locked=frozenset([("A", "rx")])), "unknown rate of A 'rx'"),
    "no plan": (designed(plan=None), "plan"),
    "no starts": (designed(plan=replace(PLAN, n_starts=0)), "starts"),
    "no such load shown": (designed(plan=replace(PLAN, shown_load=9)), "shown"),
    "a group twice in the plan": (designed(plan=replace(PLAN, groups=PLAN.groups * 2)), "twice"),
    "no group in the plan": (designed(plan=replace(PLAN, groups=())), "came later"),
    "a curve too many": (misfit(charts=replace(FIRST.charts, curves=())), "charts"),
    "no such point": (
        misfit(charts=replace(FIRST.charts, curves=(ResponseCurve(7, "lateral"),) * 2)),
        "response point 7",
    ),
    "a path of no point": (
        misfit(charts=replace(FIRST.charts, path_curve=ResponseCurve(-1, "lateral"))),
        "response point -1",
    ),
    "a cursor off the chart": (misfit(charts=replace(FIRST.charts, cursor_hz=1e9)), "cursor"),
    "a mode of no body": (misfit(motion=replace(FIRST.motion, component_mode=999)), "own mode"),
    "too fast": (misfit(conditions=Conditions("flat", 1e5)), "speed"),
    "so slow that the road is not known": (misfit(conditions=Conditions("flat", 1e-3)), "flat"),
}


@pytest.mark.parametrize(("state", "words"), MISFITS.values(), ids=MISFITS)
def test_what_the_vehicle_cannot_have_is_refused_or_put_right(state, words):
    with pytest.raises(ModevizError, match=words):
        check_fits(state, FIRST, VEHICLE, "state")
    check_fits(fitted(state, FIRST, VEHICLE).state, FIRST, VEHICLE, "state")


NASTY = [None, True, -1, 0, 1e99, 10**30, "", "nobody", [], {}, [[]], {"a": 1}, "A", 3]


@pytest.mark.parametrize("seed", range(150))
def test_any_damage_is_refused_or_leaves_a_state_that_fits(seed):
    rng, data = random.Random(seed), CONTENT
    for _ in range(rng.randrange(1, 4)):
        path = rng.choice([*leaves(data)])
        data = put(data, path[: rng.randrange(1, len(path) + 1)] if path else path, rng.choice(NASTY))
    try:
        state = read(json.dumps({"version": 1, "content": data}))
    except ModevizError:
        return
    check_fits(fitted(state, FIRST, VEHICLE).state, FIRST, VEHICLE, "state")


def without_group(vehicle, name):
    return replace(vehicle, mount_groups=tuple(g for g in vehicle.mount_groups if g.name != name))


def test_what_is_left_of_a_vehicle_that_has_changed_keeps_its_state_and_the_rest_is_told():
    state = replace(RICH, group="B", against="Original")
    changed = without_group(VEHICLE, "B")
    usual = first_state(changed, changed.rates, Conditions("flat", 20.0))
    found = fitted(state, usual, changed)
    assert any("unknown mount group 'B'" in remark for remark in found.remarks)
    assert found.state.design.rates["A"] == state.design.rates["A"]
    assert {*found.state.design.rates} == {"A", *(a.name for a in state.design.alterations.absorbers)}
    assert found.state.design.alterations.absorbers == state.design.alterations.absorbers
    assert found.state.charts.curves == state.charts.curves
    assert found.state.group == ""
    assert found.state.look == state.look
    check_fits(found.state, usual, changed, "state")


def test_a_rate_outside_bounds_that_are_new_is_kept_and_told():
    group = VEHICLE.mount_group("A")
    stiffer = replace(group, bounds=(MountRates(5e5, 1e5, 1e5), group.bounds[1]))
    changed = replace(VEHICLE, mount_groups=(stiffer, VEHICLE.mount_group("B")))
    soft = decisions.SetRate("A", "vertical", 4e5).apply(FIRST, VEHICLE)
    found = fitted(soft, first_state(changed, changed.rates, FIRST.conditions), changed)
    assert found.state.design.rates == soft.design.rates
    assert not found.remarks
    told = outside_bounds(found.state.design, changed)
    assert len(told) == 1
    assert "A vertical rate: found 400000" in told[0]
    assert not outside_bounds(soft.design, VEHICLE)


def test_numbers_of_numpy_are_written_as_numbers():
    speed = replace(FIRST, conditions=Conditions("flat", np.float64(20.0)))
    assert read(text_of(speed)) == FIRST


def test_sets_in_another_order_make_the_same_text():
    one, other = (
        replace(FIRST, charts=replace(Charts(), overlaid=frozenset(names)))
        for names in (["Soft", "Original", "x"], ["x", "Original", "Soft"])
    )
    assert text_of(one) == text_of(other)
