"""[[damper_group]] and [[spring_group]]: dampers and springs of a file are tuned where they are."""

import json
from dataclasses import replace

import numpy as np
import pytest

from modeviz.analysis.driven import driven
from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare, prepare_modes
from modeviz.cli import main
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.response import direct_response
from modeviz.errors import ModevizError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.survey import survey
from modeviz.mounting.static_system import prepare_statics
from modeviz.mounting.statics import solve_statics
from modeviz.optimise.design_space import design_space
from modeviz.ride.excitation import generalised_forces
from modeviz.vehicle.connections import Damper
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.tuned_parts import tuned_group

F = np.arange(1.0, 20.5, 0.5)
FILE = """
name = "cab"
mount_table = "mounts.csv"
highest_frequency = 20

[units]
length = "m"
mass = "kg"
inertia = "kg m²"
stiffness = "N/m"
damping = "N s/m"
rotational_stiffness = "N m/rad"
rotational_damping = "N m s/rad"
acceleration = "m/s²"
[[rigid_body]]
name = "cab"
role = "cabin"
mass = 900
center_of_gravity = [0.1, 0.05, 1.2]
inertia = [500, 450, 400]

[[spring]]
name = "stop"
group = "stops"
bodies = ["cab", "ground"]
at = [0.9, 0, 0.9]
stiffness = [0, 0, 40000]
rigid = ["x", "rz"]

[[damper]]
name = "front left"
group = "struts"
bodies = ["cab", "ground"]
at = [[-0.8, -0.5, 1.0], [-0.8, -0.5, 0.6]]
damping = [20, 0, 3000]
rotational_damping = [0, 0, 7]

[[damper]]
name = "front right"
group = "struts"
bodies = ["cab", "ground"]
at = [[-0.8, 0.5, 1.0], [-0.8, 0.5, 0.6]]
axes = [[0.8, 0, 0.6], [0, 1, 0], [-0.6, 0, 0.8]]
damping = [20, 0, 3000]

[[response_point]]
name = "seat"
body = "cab"
at = [0.2, -0.4, 1.7]

[[base_motion]]
name = "shaking"
direction = [0.3, 0.2, 1]
acceleration = 2
"""
MOUNTS = """\
name,body 1,body 2,x [m],y [m],z [m],k_x [N/mm],k_y [N/mm],k_z [N/mm],c_z [N s/m],loss_factor,group
rubber 1,cab,ground,-0.8,-0.6,0.9,90,80,60,0,0.1,rubber
rubber 2,cab,ground,-0.8,0.6,0.9,90,80,60,0,0.1,rubber
rear,cab,ground,0.9,0,0.9,0,0,0,2500,0,rear dampers
"""
GROUPS = """
[[damper_group]]
name = "struts"
label = "front struts"
softest = { damping_vertical = 1000 }
stiffest = { damping_vertical = 9000 }

[[damper_group]]
name = "rear dampers"

[[spring_group]]
name = "stops"

[rates.firm.struts]
damping_vertical = 6000
"""


def folder(where, more="", file=FILE):
    where.mkdir(exist_ok=True)
    (where / "vehicle.toml").write_text(file + more, "utf-8")
    (where / "mounts.csv").write_text(MOUNTS, "utf-8")
    return where


@pytest.fixture
def tuned(tmp_path):
    return read_vehicle(folder(tmp_path / "tuned", GROUPS))


@pytest.fixture
def plain(tmp_path):
    return read_vehicle(folder(tmp_path / "plain"))


def test_their_dampers_and_springs_are_tuned_between_what_is_said_or_usual(tuned):
    struts, rear, stops = (tuned.mount_group(name) for name in ("struts", "rear dampers", "stops"))
    assert struts.fields == rear.fields == ("damping_vertical",)
    assert stops.fields == ("vertical",)
    bounds = [[r.damping_vertical for r in group.bounds] for group in (struts, rear)]
    assert bounds == [[1000, 9000], [625, 10000]]
    assert [r.vertical for r in stops.bounds] == [10e3, 160e3]
    assert [struts.title, struts.static_ratio, stops.static_ratio] == ["struts  front struts", 1, 1]
    assert tuned.mount_group("struts").mounts[0].rotational_damping.tolist() == [0, 0, 7]
    assert not any(type(c) is Damper for c in tuned.connections)
    assert tuned.rate_sets["firm"]["struts"].damping_vertical == 6000


def changed(vehicle, struts, stop):
    """The vehicle whose parts are not tuned, with others."""

    def other(part):
        if part.group == "struts":
            return replace(part, damping=np.array([20.0, 0.0, struts]))
        return replace(part, stiffness=np.array([0.0, 0.0, stop])) if part.name == "stop" else part

    return replace(vehicle, connections=tuple(map(other, vehicle.connections)))


@pytest.mark.parametrize(("struts", "stop"), [(3000.0, 40e3), (7500.0, 90e3)])
def test_modes_and_responses_are_those_of_the_folder_that_has_these_rates(tuned, plain, struts, stop):
    rates = {"struts": MountRates(0, 0, 0, damping_vertical=struts), "stops": MountRates(stop, 0, 0)}
    system = assemble(changed(plain, struts, stop))
    modes = solve_modal(prepare_modes(tuned), rates).modes
    expected = solve_modes(system, below_hz=20.0)
    np.testing.assert_allclose(modes.frequency_hz, expected.frequency_hz, rtol=1e-9)
    np.testing.assert_allclose(modes.damping_ratio, expected.damping_ratio, rtol=1e-7)
    prepared, load = prepare(tuned, F, is_graded=False), tuned.harmonic_load("shaking")
    found = driven(prepared, [load], 20.0).response(prepared.mount_stiffness(rates), F)
    seat = system.motion("cab", tuned.response_points[0].position)[:3]
    forces = generalised_forces(system, load, F, 20.0)
    exact = direct_response(system, F, forces, seat)
    assert np.abs(found - exact).max() < 1e-9 * np.abs(exact).max()


def test_standing_still_it_is_as_without_the_groups(tuned, plain):
    found, expected = (solve_statics(prepare_statics(assemble(v)), {}).cases for v in (tuned, plain))
    for case, its in zip(found, expected, strict=True):
        np.testing.assert_allclose(case.bodies["cab"], its.bodies["cab"], rtol=1e-9, atol=1e-12)


def test_a_folder_that_is_written_has_them_where_they_were(tuned, tmp_path):
    rates = {"struts": MountRates(0, 0, 0, damping_vertical=4200.0), "stops": MountRates(5e4, 0, 0)}
    write_vehicle(tuned.with_rates(rates), tmp_path / "written")
    text = (tmp_path / "written" / "vehicle.toml").read_text("utf-8")
    assert [
        text.count(f"[[{key}]]") for key in ("damper", "spring", "damper_group", "spring_group")
    ] == [
        3,
        1,
        2,
        1,
    ]
    again = read_vehicle(tmp_path / "written")
    assert again.rates == tuned.with_rates(rates).rates
    assert [g.bounds for g in again.mount_groups] == [g.bounds for g in tuned.mount_groups]
    assert [g.label for g in again.mount_groups] == [g.label for g in tuned.mount_groups]
    expected = solve_modal(prepare_modes(tuned), rates).modes
    modes = solve_modal(prepare_modes(again), {}).modes
    np.testing.assert_allclose(modes.frequency_hz, expected.frequency_hz, rtol=1e-12)
    np.testing.assert_allclose(modes.damping_ratio, expected.damping_ratio, rtol=1e-9)


def test_the_search_tunes_them_and_a_problem_bounds_them_alone(tmp_path):
    more = """
[[problem]]
name = "seat"
goal = "change"

[[problem.group]]
group = "struts"
softest = { damping_vertical = 2000 }
stiffest = { damping_vertical = 4000 }

[[problem.group]]
group = "stops"
"""
    vehicle = read_vehicle(folder(tmp_path / "tuned", GROUPS + more))
    space = design_space(vehicle, vehicle.problems[0].groups)
    assert [(v.group, *v.fields) for v in space.variables] == [
        ("struts", "damping_vertical"),
        ("stops", "vertical"),
    ]
    assert np.exp([space.lower[0], space.upper[0]]) == pytest.approx([2 / 3, 4 / 3])


def test_commands_and_tables_have_them_as_any_mount_group(tmp_path, capsys):
    path = folder(tmp_path / "tuned", GROUPS)
    assert main(["modes", str(path), "--set", "struts.damping-vertical=6000 N s/m", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert main(["modes", str(path), "--rates", "firm", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["modes"] == found["modes"]
    assert main(["export", str(path), str(tmp_path / "mounts.csv")]) == 0
    lines = (tmp_path / "mounts.csv").read_text("utf-8").splitlines()
    assert {"front left", "front right", "rear", "stop"} <= {line.split(",")[0] for line in lines}


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            'name = "struts"\nlabel',
            'name = "strut"\nlabel',
            "damper_group[0]: name: found 'strut', expected the group of some [[damper]]; there are "
            "struts, rear dampers",
        ),
        (
            "{ damping_vertical = 1000 }",
            "{ vertical = 1000 }",
            "damper_group[0].softest.vertical: unknown key 'vertical': did you mean 'damping_vertical'",
        ),
        (
            "{ damping_vertical = 1000 }",
            "{ damping_vertical = 9500 }",
            "damper_group[0]: group 'struts': bounds: damping-vertical: found 9500 to 9000",
        ),
        (
            'name = "rear dampers"',
            'name = "struts"',
            "damper group 'struts' is there twice",
        ),
        (
            'name = "stops"',
            'name = "stops"\nstiffest = { fore_aft = 1e5 }',
            "spring_group[0]: connection 'stop': x is rigid and has a rate, expected one of them",
        ),
    ],
)
def test_what_is_wrong_is_said_where_it_stands(tmp_path, old, new, words):
    assert old in GROUPS
    with pytest.raises(ModevizError) as error:
        read_vehicle(folder(tmp_path / "tuned", GROUPS.replace(old, new)))
    assert words in str(error.value)
    assert "\n" not in str(error.value)


def test_dampers_that_differ_are_no_group(tmp_path):
    file = FILE.replace("damping = [20, 0, 3000]", "damping = [20, 0, 3100]", 1)
    with pytest.raises(ModevizError, match=r"damping of 'front right' is .* and that of 'front left'"):
        read_vehicle(folder(tmp_path / "tuned", GROUPS, file))


def test_in_python_only_springs_or_dampers_of_one_group_are_tuned(plain):
    with pytest.raises(ModevizError, match="expected springs or dampers of one group"):
        tuned_group(plain.connections)
    with pytest.raises(ModevizError, match="found none"):
        tuned_group(())
    found = tuned_group([c for c in plain.connections if c.group == "struts"])
    assert found.bounds[1].damping_fore_aft == 80


def test_what_is_not_tuned_is_each_dampers_own(tmp_path):
    damping = "damping = [20, 0, 3000]"
    file = FILE.replace(damping, f"{damping}\nrotational_stiffness = [5, 0, 0]", 1)
    group = read_vehicle(folder(tmp_path / "tuned", GROUPS, file)).mount_group("struts")
    assert [m.rotational_stiffness.tolist() for m in group.mounts] == [[5, 0, 0], [0, 0, 0]]
    assert [m.damping.tolist() for m in group.mounts] == 2 * [[20, 0, 3000]]


def test_the_unknown_group_of_a_wrong_folder_is_taken_out_with_its_table(tmp_path):
    path = folder(tmp_path / "tuned", GROUPS.replace('name = "stops"', 'name = "stop"'))
    assert [problem.key for problem in survey(path).problems] == ["spring_group[0]"]
