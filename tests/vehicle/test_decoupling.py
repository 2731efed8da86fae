"""What rigid modes are held against, and cranks, in Python and in a vehicle's file."""

from dataclasses import replace

import numpy as np
import pytest
from four_cylinder import engine, four_cylinder, on_subframe
from oracles import Beam

import modeviz as mv
from modeviz.errors import VehicleError
from modeviz.vehicle.decoupling import USUAL, DecoupledBody, Decoupling
from modeviz.vehicle.problem import DesignGroup, Problem


@pytest.fixture
def rewritten(tmp_path):
    """Writes a vehicle, changes words of its file, and reads it again."""

    def rewrite(vehicle, *changes):
        mv.write_vehicle(vehicle, tmp_path)
        file = tmp_path / "vehicle.toml"
        text = file.read_text("utf-8")
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        file.write_text(text, "utf-8")
        return mv.read_vehicle(tmp_path)

    return rewrite


def test_targets_come_back_from_a_folder(rewritten):
    wanted = Decoupling(0.9, 6.0, 25.0, 1.0, 3.0)
    assert rewritten(replace(four_cylinder(), decoupling=wanted)).decoupling == wanted


def test_usual_targets_need_no_table(rewritten, tmp_path):
    assert rewritten(four_cylinder()).decoupling == USUAL
    assert "decoupling" not in (tmp_path / "vehicle.toml").read_text("utf-8")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("purity = 85", "decoupling.purity"),
        ("gap = -1", "decoupling.gap"),
        ("highest_frequency = 4.0", "decoupling.highest_frequency: found 4.0 Hz, expected more than"),
        ("purty = 0.9", "purity"),
    ],
)
def test_targets_that_make_no_sense_are_refused_by_key(rewritten, given, words):
    with pytest.raises(VehicleError) as refused:
        rewritten(four_cylinder(), ("[units]", f"[decoupling]\n{given}\n\n[units]"))
    assert words in str(refused.value)


def test_targets_made_in_python_are_checked():
    for wrong in ({"purity": 0.0}, {"gap": np.nan}, {"lowest_frequency": 40.0}):
        with pytest.raises(VehicleError):
            Decoupling(**wrong)


def test_a_crank_comes_back_from_a_folder_as_a_unit_vector(rewritten):
    vehicle = rewritten(four_cylinder(engine(crank_axis=np.array([0.0, 3.0, 4.0]))))
    assert vehicle.bodies[0].crank_axis == pytest.approx([0.0, 0.6, 0.8])


def test_a_crank_turns_with_the_axes_of_its_file_and_may_be_a_word(rewritten):
    turned = rewritten(
        four_cylinder(),
        ('name = "four-cylinder"', 'name = "four-cylinder"\naxes = "x forward, y left, z up"'),
        ('label = "engine"', 'label = "engine"\ncrank_axis = [1.0, 2.0, 0.0]'),
    )
    assert turned.bodies[0].crank_axis == pytest.approx(np.array([-1.0, -2.0, 0.0]) / np.sqrt(5))
    said = rewritten(four_cylinder(), ('label = "engine"', 'label = "engine"\ncrank_axis = "lateral"'))
    assert said.bodies[0].crank_axis.tolist() == [0.0, 1.0, 0.0]


def test_a_flexible_body_may_have_a_crank(rewritten):
    body = replace(Beam(4).body("beam"), crank_axis=np.array([0.0, 2.0, 0.0]))
    assert rewritten(mv.Vehicle("beam", (body,), ())).bodies[0].crank_axis.tolist() == [0, 1, 0]


def test_a_crank_without_length_is_refused(rewritten):
    with pytest.raises(VehicleError, match=r"'engine': crank_axis: found .*, expected a direction"):
        engine(crank_axis=np.zeros(3))
    with pytest.raises(VehicleError, match="crank_axis"):
        rewritten(
            four_cylinder(), ('label = "engine"', 'label = "engine"\ncrank_axis = [0.0, 0.0, 0.0]')
        )


def test_bodies_of_a_problem_come_back_from_a_folder(rewritten):
    bodies = DecoupledBody("engine", ("z", "ry"), "crank"), DecoupledBody("subframe")
    vehicle = on_subframe()
    groups = (DesignGroup("M1"),)
    problem = Problem("pure", groups, goal="purity", decoupling=bodies)
    assert rewritten(replace(vehicle, problems=(problem,))).problems[0].decoupling == bodies


def test_a_body_that_a_problem_names_must_be_there(rewritten):
    problem = Problem("pure", (DesignGroup("M1"),), goal="purity", decoupling=(DecoupledBody("engin"),))
    with pytest.raises(VehicleError, match="engine"):
        replace(four_cylinder(), problems=(problem,))
    with pytest.raises(VehicleError, match=r"problem 'pure'.*'engine'"):
        Problem(
            "pure",
            (DesignGroup("M1"),),
            goal="purity",
            decoupling=(DecoupledBody("engine"), DecoupledBody("engine")),
        )
