"""Mounts as CBUSH and PBUSH cards do what the mounts do, in any units."""

import numpy as np
import pytest
from bulk_data import bulk_data
from many_mounts import MOUNTS, many_mounts
from turned_vehicles import text, turned_folder

from modeviz.dynamics.assembly import assemble
from modeviz.export.bushes import UNIT_NAMES, bush_deck
from modeviz.files import read_vehicle
from modeviz.files.schema.axes import axes_of
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.units import UNITS
from modeviz.vehicle.connections import GROUND
from modeviz.vehicle.vehicle import Vehicle

FIRST = 90001


def deck(units: str, vehicle: Vehicle | None = None) -> dict[str, list[list]]:
    cards = bulk_data(bush_deck(vehicle or many_mounts(), UNIT_SYSTEMS[units], FIRST).decode("ascii"))
    return {name: [card[1:] for card in cards if card[0] == name] for name in {c[0] for c in cards}}


def six(fields):
    """Six fields as numbers, zero where nothing stands."""
    return np.array([field or 0.0 for field in [*fields, *[0.0] * 6][:6]], float)


def after(card, key):
    """The numbers of a PBUSH after "K", "B" or "GE"."""
    return six(card[card.index(key) + 1 :]) if key in card else np.zeros(6)


def rows_of(cards, cid):
    """The axes of a coordinate system as rows, after the definition of CORD2R."""
    if cid == 0:
        return np.eye(3)
    a, b, c = np.array(next(card for card in cards["CORD2R"] if card[0] == cid)[2:11]).reshape(3, 3)
    z = (b - a) / np.linalg.norm(b - a)
    y = np.cross(z, c - a)
    y /= np.linalg.norm(y)
    return np.array([np.cross(y, z), y, z])


def carried(motion, arm):
    """Six motions of a point, carried along a rigid arm."""
    return np.concatenate([motion[:3] + np.cross(motion[3:], arm), motion[3:]])


OTHERS = [("forward", "left", "up"), ("right", "forward", "up"), ("down", "right", "rearward")]


@pytest.mark.parametrize(
    ("units", "words"),
    [*((units, None) for units in UNIT_SYSTEMS), *(("mm-t-s", words) for words in OTHERS)],
)
def test_cards_store_the_energy_of_the_mounts(units, words, tmp_path):
    """½ Σ k u², u the motion of GA less that of GB at S of the way, along the system CID.

    In the axes of the vehicle's file, whatever these are.
    """
    vehicle, turn = many_mounts(), np.eye(3)
    if words:
        vehicle = read_vehicle(turned_folder(tmp_path / "turned", vehicle, words))
        turn = axes_of(text(words)).T
    cards, system, unit = deck(units, vehicle), assemble(vehicle), UNIT_SYSTEMS[units]
    force = unit.mass * unit.length
    q = np.random.default_rng(1).standard_normal(system.n_dofs)
    grids = {card[0]: np.array(card[2:5], float) * unit.length for card in cards["GRID"]}
    properties = {card[0]: card for card in cards["PBUSH"]}
    for mount, (_, pid, *ends, _, _, _, cid), s in zip(
        vehicle.mounts, (card[:8] for card in cards["CBUSH"]),
        (card[8] if len(card) > 8 else 0.5 for card in cards["CBUSH"]), strict=True,
    ):  # fmt: skip
        first, second = (grids[end] for end in ends)
        center = first + s * (second - first)
        moved = [
            carried(
                np.kron(np.eye(2), turn) @ system.motion(body, turn.T @ place) @ q
                if body != GROUND
                else np.zeros(6),
                center - place,
            )
            for body, place in zip(mount.bodies, (first, second), strict=True)
        ]
        stretch = np.kron(np.eye(2), rows_of(cards, cid)) @ (moved[0] - moved[1])
        k = after(properties[pid], "K") * np.repeat([force / unit.length, force * unit.length], 3)
        expected = np.concatenate([mount.stiffness, mount.rotational_stiffness])
        relative = system.relative_motion(mount) @ q
        assert k @ stretch**2 == pytest.approx(expected @ relative**2, rel=1e-9)


def test_damping_is_that_of_the_mounts():
    cards, mounts = deck("m-kg-s"), many_mounts().mounts
    properties = {card[0]: card for card in cards["PBUSH"]}
    for mount, card in zip(mounts, cards["CBUSH"], strict=True):
        assert after(properties[card[1]], "GE") == pytest.approx(np.full(6, mount.loss_factor))
        viscous = np.concatenate([mount.damping, mount.rotational_damping])
        assert after(properties[card[1]], "B") == pytest.approx(viscous)


def test_mounts_alike_share_a_property_and_all_numbers_count_from_the_first():
    cards = deck("mm-t-s")
    assert [card[0] for card in cards["GRID"]] == list(range(FIRST, FIRST + 14))
    assert [card[:2] for card in cards["CBUSH"]] == [
        [FIRST + i, FIRST + pid] for i, pid in enumerate([0, 0, 1, 1, 2, 3, 4])
    ]
    assert [card[0] for card in cards["PBUSH"]] == list(range(FIRST, FIRST + 5))


def test_the_ground_is_a_grid_that_is_held():
    grids = deck("mm-t-s")["GRID"]
    assert [card[0] for card in grids if 123456 in card[6:7]] == [FIRST + 13]


def test_comments_say_units_and_name_every_mount_and_property():
    lines = bush_deck(many_mounts(), UNIT_SYSTEMS["in-lbf-s"], FIRST).decode("ascii").splitlines()
    said = " ".join(line[2:] for line in lines if line.startswith("$"))
    assert "length in, mass lbf s^2/in, force lbf, time s; rates lbf/in and lbf in/rad" in said
    assert "x rearward, y right, z up" in said
    for mount in MOUNTS:
        assert f"{mount.name}, group Z" in said
    assert "PBUSH 90003: group Z (all kinds): fore-aft 81.5" in said
    assert "K1 fore-aft, K2 lateral, K3 vertical" in said


@pytest.mark.parametrize(("name", "words"), UNIT_NAMES.items())
def test_names_of_units_are_those_of_the_systems(name, words):
    length, mass, force = words
    assert UNITS["length"][length] == UNIT_SYSTEMS[name].length
    assert UNITS["mass"][mass] == pytest.approx(UNIT_SYSTEMS[name].mass)
    of_force = UNIT_SYSTEMS[name].mass * UNIT_SYSTEMS[name].length
    assert {**UNITS["force"], "mN": 1e-3}[force] == pytest.approx(of_force)
