"""What nothing holds is found, named, and told apart from the motion of the whole."""

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from small_vehicles import on_tyres, wheel

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.free_motions import FreeMotion, free_motions
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Rod, Spring
from modeviz.vehicle.vehicle import Vehicle

AXES = ("x", "y", "z", "rx", "ry", "rz")


def body(name: str, x: float, inertia: tuple[float, ...] = (3.0, 5.0, 7.0)) -> RigidBody:
    return RigidBody(name, "other", name, 10.0, np.array([x, 0.2, 0.5]), np.diag(inertia))


def joint(name: str, bodies: tuple[str, str], x: float, **rates) -> Spring:
    return Spring(name, "joints", bodies, np.tile([x, 0.2, 0.5], (2, 1)), **rates)


def found(bodies, connections) -> tuple[FreeMotion, ...]:
    return free_motions(assemble(Vehicle("test", bodies, connections)))


def test_what_is_held_has_no_free_motion():
    assert free_motions(assemble(mounted_cabin())) == ()


def test_a_vehicle_in_space_is_free_in_six_ways_as_a_whole_and_no_mechanism():
    bodies = body("a", 0), body("b", 1)
    stiff = {"stiffness": np.full(3, 1e5), "rotational_stiffness": np.full(3, 1e4)}
    free = found(bodies, (joint("j", ("a", "b"), 0.5, **stiff),))
    assert free == tuple(FreeMotion(("a", "b"), motion, True) for motion in AXES)


def test_each_island_has_its_own_free_motions():
    free = free_motions(on_tyres(wheel("a"), wheel("b", 2.0)))  # tyres stiff along z alone
    assert {(f.bodies, f.motion) for f in free} == {
        ((name,), motion) for name in "ab" for motion in ("x", "y", "rx", "ry", "rz")
    }
    assert all(f.is_whole for f in free)


@pytest.mark.parametrize("held", [{"stiffness": np.full(3, 1e6)}, {"rigid": ("x", "y", "z")}])
def test_a_shaft_in_its_bearings_spins_alone_whether_these_are_springs_or_joints(held):
    first = joint("first", ("shaft", GROUND), 0.0, **held)
    if "rigid" in held:  # two joints would hold it along x twice
        held = {"rigid": ("y", "z")}
    free = found((body("shaft", 0.5),), (first, joint("second", ("shaft", GROUND), 1.0, **held)))
    assert free == (FreeMotion(("shaft",), "rx", True),)


def test_an_arm_on_a_ball_joint_turns_about_all_axes_while_the_rest_is_held():
    held = {"stiffness": np.full(3, 1e5), "rotational_stiffness": np.full(3, 1e5)}
    ball = joint("ball", ("arm", "base"), 1.0, stiffness=np.full(3, 1e6))
    free = found(
        (body("base", 0.0), body("arm", 1.0)), (joint("j", ("base", GROUND), 0.0, **held), ball)
    )
    assert [(f.bodies[0], f.motion, f.is_whole) for f in free] == [
        ("arm", motion, False) for motion in ("rx", "ry", "rz")
    ]


def test_bodies_that_only_move_together_are_one_mechanism():
    """Two blocks on rails along x, a rod between them: one motion, with both in it."""
    rails = tuple(
        joint(
            n, (n, GROUND), x, stiffness=np.array([0, 1e6, 1e6]), rotational_stiffness=np.full(3, 1e5)
        )
        for n, x in (("a", 0.0), ("b", 1.0))
    )
    ends = np.array([[0.0, 0.2, 0.5], [1.0, 0.2, 0.5]])
    third = joint(
        "c", ("c", GROUND), 2.0, stiffness=np.full(3, 1e5), rotational_stiffness=np.full(3, 1e5)
    )
    tie = joint("tie", ("c", "a"), 0.0, stiffness=np.array([0, 1e3, 0]))
    free = found(
        (body("a", 0.0), body("b", 1.0), body("c", 2.0)),
        (*rails, Rod.between("rod", "rods", ("a", "b"), ends, 1e6), third, tie),
    )
    assert len(free) == 1
    assert (set(free[0].bodies), free[0].motion, free[0].is_whole) == ({"a", "b"}, "x", False)
