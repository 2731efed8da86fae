"""Whatever people write of attachments, poses, planes and compliance ends in no traceback."""

import random
from collections.abc import Callable

import numpy as np
import pytest

from modeviz.errors import LONGEST, VehicleError
from modeviz.formats.attachments import find_attachments
from modeviz.formats.body import flexible_body
from modeviz.formats.component import UNIT_SYSTEMS, Component, Modes
from modeviz.formats.halves import parse_plane
from modeviz.formats.nastran.bulk import Card
from modeviz.formats.nastran.rigid_elements import node_set
from modeviz.formats.places import parse_place
from modeviz.formats.poses import parse_pose
from modeviz.formats.residuals import with_given_compliance
from modeviz.vehicle.rigid import rigid_motions

SI = UNIT_SYSTEMS["m-kg-s"]
WORDS = [
    *(
        "a=",
        "a=",
        "rigid:",
        "mean:",
        "RBE2:5",
        "1",
        "2",
        "3",
        "4",
        "77",
        ",",
        ",",
        "-",
        "@",
        ";",
        " at ",
    ),
    *("x=", "y=", "z=", "x forward", "y left", "z up", "0,1,0", "1,0,0", "nan", "inf", "²", "٣"),
    *("=", " ", ".csv", "é"),
]
FIELDS = ["", "1", "2", "3", "123", "123456", "1.0", "UM", "ALPHA", "THRU", "-4", "²", "x"]
COMPONENT_PLACES = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])


@pytest.fixture(scope="module")
def readers() -> list[Callable[[str], object]]:
    """What reads such texts, of a tetrahedron with its rigid modes and an elastic one."""
    shapes = np.concatenate([rigid_motions(COMPONENT_PLACES), np.ones((4, 6, 1))], axis=2)
    modes = Modes(np.r_[np.zeros(6), 30.0], np.ones(7), np.full(7, np.nan), shapes)
    component = Component(np.arange(1, 5), COMPONENT_PLACES, {}, modes)
    (at,) = find_attachments(component, [parse_place("a=1")], SI)
    body, _ = flexible_body(component, SI, "box", [at])
    return [
        lambda text: find_attachments(component, [parse_place(text)], SI),
        lambda text: parse_pose(text, component, 1.0, np.eye(3)),
        parse_plane,
        lambda text: with_given_compliance(body, [text], SI),
    ]


def is_understood(read: Callable, *given) -> bool:
    """Whether it is; what is refused is so in a sentence."""
    try:
        read(*given)
    except VehicleError as error:
        if len(str(error)) > LONGEST or len(str(error).splitlines()) != 1:
            raise
        return False
    return True


@pytest.mark.parametrize("seed", range(6))
def test_any_text_is_understood_or_refused(readers, seed):
    rng = random.Random(seed)
    understood = 0
    for _ in range(1000):
        text = "".join(rng.choices(WORDS, k=rng.randint(0, 9)))
        understood += max(is_understood(read, text) for read in readers)
    assert understood > 10


@pytest.mark.parametrize("text", ["a=mean:1-99999999999999", "a=1@1,1,1e400", "a=" + "1," * 5000])
def test_texts_of_any_length_are_refused(readers, text):
    for read in readers:
        assert not is_understood(read, text)


@pytest.mark.parametrize("name", ["RBE2", "RBE3", "SET1"])
def test_any_card_of_a_set_is_understood_or_refused(name):
    rng = random.Random(name)
    cards = [Card(name, rng.choices(FIELDS, k=rng.randint(0, 16))) for _ in range(3000)]
    assert 10 < sum(is_understood(node_set, card) for card in cards) < 2900
