"""Springs and bushings out of Nastran input files."""

import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from free_network import CORNERS, LABELS
from scipy.spatial.transform import Rotation
from two_networks import ATTACHED, joined_frequencies, place, two_networks

from modeviz.cli import main
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.formats.nastran.bushings import read_bushings
from modeviz.vehicle.connections import GROUND, Damper, Mount, Spring

MM = UNIT_SYSTEMS["mm-t-s"]


def free(*fields) -> str:
    return ",".join(str(field) for field in fields)


def grids(numbers, places, output=0):
    return [free("GRID", n, "", *map(float, p), output) for n, p in zip(numbers, places, strict=True)]


@pytest.fixture
def deck(tmp_path):
    """An input file of cards."""

    def deck(*cards) -> Path:
        path = tmp_path / "joints.bdf"
        path.write_text("\n".join(["BEGIN BULK", *cards, "ENDDATA"]) + "\n")
        return path

    return deck


@pytest.fixture
def read(deck):
    """The bushings of cards, and what is said of them."""

    def read(*cards, frequency=None, bodies=(), units=MM):
        notes = []
        return read_bushings(deck(*cards), units, frequency, bodies, notes.append), notes

    return read


@pytest.fixture(scope="module")
def networks(tmp_path_factory):
    scratch = tmp_path_factory.mktemp("networks")
    return two_networks(scratch / "vehicle", scratch)


@pytest.fixture
def pair(networks, tmp_path):
    return Path(shutil.copytree(networks, tmp_path / "pair"))


def put(path, folder, *options, units="mm-t-s") -> int:
    """What `modeviz import` ends with that puts a file into a folder."""
    return main(["import", str(path), "--output", str(folder), "--units", units, *options])


def there_and_back(table, pair, networks, *options):
    """The vehicle with the mounts of a table, and that with those of its cards; they vibrate alike."""
    path = pair.parent / "mounts.csv"
    path.write_text("\n".join(table))
    assert main(["import", str(path), "--output", str(pair)]) == 0
    cards = pair.parent / "rates.bdf"
    assert main(["export", str(pair), str(cards)]) == 0
    again = Path(shutil.copytree(networks, pair.parent / "again"))
    assert put(cards, again, *options) == 0
    first, second = (read_vehicle(folder) for folder in (pair, again))
    frequencies = [solve_modes(assemble(vehicle)).frequency_hz[6:] for vehicle in (first, second)]
    np.testing.assert_allclose(*frequencies, rtol=1e-9)
    return second


TWO = grids([1, 2], [[0, 0, 0], [100, 0, 0]])
PBUSH = "PBUSH,7,K,10.,20.,30.,4.+3,5.+3,6.+3"
K = [10_000, 20_000, 30_000, 4, 5, 6]


@pytest.mark.parametrize("axes", ["", 'axes = "x forward, y left, z up"\n'])
def test_bushes_between_flexible_bodies_couple_as_the_whole_matrices_do(pair, axes, deck):
    """Grids of the lower body have other numbers: they are found by place; CID turns the axes.

    In whichever axes the vehicle's file is, the deck is in the same.
    """
    toml = pair / "vehicle.toml"
    toml.write_text(axes + toml.read_text())
    turn = Rotation.from_euler("xyz", [20, -35, 50], degrees=True).as_matrix()
    rates = {n: np.array([10.0, 25.0, 60.0]) * (i + 1) for i, n in enumerate(ATTACHED)}
    cards = [
        *grids(LABELS, CORNERS),
        *grids(LABELS + 1000, CORNERS),
        free("CORD2R", 5, 0, 0.0, 0.0, 0.0, *turn[:, 2], *turn[:, 0]),
    ]
    for i, node in enumerate(ATTACHED):
        cards += [
            free("PBUSH", i + 1, "K", *rates[node]),
            free("CBUSH", 100 + i, i + 1, node, node + 1000, "", "", "", 5),
        ]
    path = deck(*cards)
    assert put(path, pair) == 0
    vehicle = read_vehicle(pair)
    assert {frozenset(m.bodies) for m in vehicle.mounts} == {frozenset({"upper", "lower"})}
    assert [g.name for g in vehicle.mount_groups] == ["PBUSH 1", "PBUSH 2", "PBUSH 3", "PBUSH 4"]
    expected = joined_frequencies([(n, turn * rates[n] @ turn.T) for n in ATTACHED])
    found = solve_modes(assemble(vehicle)).frequency_hz
    np.testing.assert_allclose(found[6:30], expected[6:30], rtol=2e-4)


def test_scalar_springs_and_grounded_bushes_hold_as_the_whole_matrices_do(pair, deck):
    cards = [*grids(LABELS, CORNERS), *grids(LABELS + 1000, CORNERS), "PELAS,3,40.,,,4,90."]
    for i, node in enumerate(ATTACHED):
        cards += [free("CELAS2", 10 * i + d, 25.0 * d, node, d, node + 1000, d) for d in (1, 2, 3)]
    cards += ["CELAS1,50,3,11,1", "CELAS1,51,4,,,11,2", "CBUSH,52,8,1014,,,,,0", "PBUSH,8,K,70.,,80."]
    path = deck(*cards)
    bodies = ["--bodies", "upper", "lower"]
    assert put(path, pair, *bodies) == 0
    vehicle = read_vehicle(pair)
    grounded = [(11, np.diag([40.0, 90.0, 0])), (14, np.diag([70.0, 0, 80.0]))]
    expected = joined_frequencies([(n, np.diag([25.0, 50, 75])) for n in ATTACHED], grounded)
    found = solve_modes(assemble(vehicle)).frequency_hz
    np.testing.assert_allclose(found[2:30], expected[2:30], rtol=2e-4)


def test_mounts_that_are_written_as_cards_come_back_as_they_were(pair, networks):
    """But for their names; large fields hold all digits of a number that is not too long."""
    lines = ["name,group,node 1,node 2,body 1,body 2,kx [N/mm],ky [N/mm],kz [N/mm],yaw [deg],eta"]
    lines += [f"m{n},M,{n},{n},upper,lower,10,20,30,{3 * n},0.1" for n in ATTACHED]
    second = there_and_back(lines, pair, networks)
    assert second.mount_groups[0].loss_factor == pytest.approx(0.1)
    assert len(second.mount_groups) == 1


def test_a_bush_has_the_axes_of_its_cid_also_at_its_grid_in_a_cylinder(read):
    cards = [*TWO, *grids([3], [[100, 100, 0]]), PBUSH, "CORD2C,6,,0.,0.,0.,0.,0.,1.,1.,0.,0."]
    (found,), _ = read(*cards, "CBUSH,1,7,3,2,,,,6")
    s = np.sqrt(0.5)
    np.testing.assert_allclose(found.axes, [[s, s, 0], [-s, s, 0], [0, 0, 1]], atol=1e-12)
    np.testing.assert_allclose(found.stiffness, K)
    assert found.group == "PBUSH 7"
    np.testing.assert_allclose([end.place for end in found.ends], [[0.1, 0.1, 0], [0.1, 0, 0]])


def test_cid_goes_before_go_and_go_before_the_vector(read):
    """x along the grids, GO or the vector in the xy plane; the vector is in the grid's own system."""
    cards = [*grids([1], [[0, 0, 0]], output=9), *grids([2, 3], [[0, 0, 50], [0, 7, 20]])]
    cards += ["CORD2R,9,,0.,0.,0.,1.,0.,0.,0.,1.,0.", PBUSH]  # its x is y, its y is z, its z is x
    (by_cid, by_grid, by_vector), _ = read(
        *cards, "CBUSH,1,7,1,2,3,,,0", "CBUSH,2,7,1,2,3", "CBUSH,3,7,1,2,1.,5.,0."
    )
    np.testing.assert_allclose(by_cid.axes, np.eye(3))
    expected = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]
    np.testing.assert_allclose(by_grid.axes, expected, atol=1e-12)
    np.testing.assert_allclose(by_vector.axes, expected, atol=1e-12)


def test_a_bush_acts_at_its_fraction_or_at_its_offset(read):
    cards = [*TWO, PBUSH, "CORD2R,9,,5.,5.,5.,6.,5.,5.,5.,6.,5."]
    (half, fraction, offset), _ = read(
        *cards, "CBUSH,1,7,1,2,,,,0", "CBUSH,2,7,1,2,,,,0", ",.3", "CBUSH,3,7,2,1,,,,0", ",,9,1.,2.,3."
    )
    assert (half.elastic_center, half.acts_at) == (0.5, None)
    assert fraction.elastic_center == 0.3
    np.testing.assert_allclose(offset.acts_at, np.array([100 + 3, 1, 2]) / 1000)


def test_an_offset_carries_the_motion_of_both_ends_by_rigid_arms(tmp_path):
    """The force of a bush above its grids turns the body about them."""
    folder = tmp_path / "v"
    folder.mkdir()
    (folder / "vehicle.toml").write_text(
        'name = "b"\nunits = { length = "m", mass = "kg", inertia = "kg m²", stiffness = "N/mm" }\n'
        '[[rigid_body]]\nname = "b"\nmass = 2.0\ncenter_of_gravity = [0, 0, 0]\ninertia = [1, 1, 1]\n'
    )
    path = tmp_path / "j.bdf"
    cards = ["GRID,1,,0.,0.,0.", "PBUSH,7,K,3.", "CBUSH,1,7,1,,,,,0", ",,0,0.,0.,500."]
    path.write_text("\n".join(["BEGIN BULK", *cards]))
    options = ["--output", str(folder), "--units", "mm-t-s", "--bodies", "b", "ground"]
    assert main(["import", str(path), *options]) == 0
    highest = solve_modes(assemble(read_vehicle(folder))).frequency_hz[-1]
    assert highest == pytest.approx(np.sqrt(3000 * (1 / 2 + 0.5**2 / 1)) / (2 * np.pi))


def test_without_orientation_a_bush_along_its_line_is_read_and_no_other(read):
    cards = grids([1, 2], [[0, 0, 0], [30, 40, 0]])
    (found,), _ = read(*cards, "PBUSH,7,K,10.,,,4.", "CBUSH,1,7,1,2")
    np.testing.assert_allclose(found.axes[0], [0.6, 0.8, 0])
    np.testing.assert_allclose(found.axes @ found.axes.T, np.eye(3), atol=1e-12)
    with pytest.raises(VehicleError, match="CBUSH 1: has rates across its line"):
        read(*cards, PBUSH, "CBUSH,1,7,1,2")


def test_damping_loss_factor_mass_and_rigid_directions(read):
    cards = [
        *TWO,
        "CBUSH,1,7,1,2,,,,0",
        "PBUSH,7,K,10.,RIGID,30.,,,,",
        ",,B,1.,2.,3.,4.,5.,6.",
        ",,GE,.12",
    ]
    (found,), notes = read(*cards, ",,M,.5")
    assert found.rigid == ("y",)
    np.testing.assert_allclose(found.damping, [1e3, 2e3, 3e3, 4e-3, 5e-3, 6e-3])
    assert found.loss_factor == 0.12
    assert notes == ["PBUSH 7: M .5: masses and the like are left out"]


def test_loss_factors_that_differ_are_one_by_stiffness_and_said(read):
    cards = [*TWO, "CBUSH,1,7,1,2,,,,0", "PBUSH,7,K,10.,30.,,,5.,", ",,GE,.1,.2,.9,,.3"]
    (found,), notes = read(*cards)
    assert found.loss_factor == pytest.approx((10 * 0.1 + 30 * 0.2) / 40)
    assert notes == [
        "CBUSH 1: its loss factors differ by direction, 0.1 to 0.3; taken as 0.175, their mean along "
        "the axes weighted by stiffness"
    ]


FREQUENT = [
    *TWO, PBUSH, "CBUSH,1,7,1,2,,,,0", "PBUSHT,7,K,21,22", ",,GE,23",
    "TABLED1,21", ",0.,100.,10.,200.,20.,400.,ENDT",
    "TABLED1,22,LOG,LOG", ",1.,10.,100.,1000.,ENDT",
    "TABLED1,23", ",0.,.0,SKIP,SKIP,50.,.5,ENDT",
]  # fmt: skip


def test_rates_over_frequency_are_taken_at_the_one_that_is_named(read):
    (nominal,), notes = read(*FREQUENT)
    np.testing.assert_allclose(nominal.stiffness, K)
    assert "depend on frequency; the nominal ones are taken" in notes[0]
    (found,), notes = read(*FREQUENT, frequency=15.0)
    np.testing.assert_allclose(found.stiffness, [300e3, 150e3, *K[2:]])
    assert found.loss_factor == pytest.approx(0.15)
    assert notes == ["PBUSH 7: its rates are those at 15 Hz"]


def test_scalar_springs_of_the_same_grids_are_one_in_the_directions_of_the_first(read):
    cards = [*grids([1], [[0, 0, 0]], output=9), *grids([2], [[0, 0, 0]], output=9)]
    cards += ["CORD2R,9,,0.,0.,0.,1.,0.,0.,0.,1.,0.", "CELAS2,4,10.,1,1,2,1", "CELAS2,5,20.,1,3,2,3"]
    found, _ = read(*cards, "CELAS2,6,30.,1,5,2,5", "CELAS2,7,40.,1,1,2,1,.2")
    first, other = found
    np.testing.assert_allclose(first.stiffness, [10e3, 0, 20e3, 0, 30e-3, 0])
    np.testing.assert_allclose(first.axes, [[0, 1, 0], [0, 0, 1], [1, 0, 0]], atol=1e-12)
    assert (first.name, first.group, other.name, other.loss_factor) == ("CELAS 4", None, "CELAS 7", 0.2)


def test_scalar_springs_that_are_apart_across_their_direction_are_said_to_be(read):
    _, notes = read(*TWO, "CELAS2,4,10.,1,1,2,1")
    assert notes == []
    _, notes = read(*TWO, "CELAS2,4,10.,1,3,2,3")
    assert "CELAS2 4: the grids are apart across the direction; taken to act halfway" in notes[0]


def test_springs_of_scalar_points_are_left_out_and_told(read):
    found, notes = read(*TWO, "SPOINT,50", "CELAS2,4,10.,50,,1,1", "CELAS2,5,10.,1,1")
    assert [bushing.name for bushing in found] == ["CELAS 5"]
    assert notes == ["CELAS2 4: hold on to scalar points, which no body has, and are left out"]


def test_fields_are_read_in_every_form(read):
    small = f"{'CBUSH':8}{1:>8}{7:>8}{1:>8}{2:>8}{'':24}{0:>8}"
    large = f"{'CBUSH*':8}{2:>16}{7:>16}{1:>16}{2:>16}\n{'*':8}{'':48}{0:>16}\n{'*':8}{0.25:>16}"
    (first, second), _ = read(*TWO, PBUSH, small, large)
    np.testing.assert_allclose(first.axes, np.eye(3))
    assert second.elastic_center == 0.25


def test_elements_that_are_not_read_are_told(read):
    _, notes = read(*TWO, PBUSH, "CBUSH,1,7,1,2,,,,0", "CDAMP2,8,1.,1,1", "CELAS4,9,1.,1,2")
    assert notes == ["1 CDAMP2, 1 CELAS4 are left out"]


def test_a_bush_of_dampers_alone_and_a_rigid_one_are_what_they_are(pair, deck):
    cards = [*grids(LABELS, CORNERS), "PBUSH,7,B,.5", "CBUSH,1,7,11,,,,,0"]
    cards += ["PBUSH,8,K,RIGID,3.", "CBUSH,2,8,14,,,,,0", "PBUSH,9,K,3.", "CBUSH,3,9,22,,,,,0"]
    path = deck(*cards)
    options = ["--units", "mm-t-s", "--bodies", "upper", "ground"]
    assert main(["import", str(path), "--output", str(pair), *options]) == 0
    kinds = {c.name: type(c) for c in read_vehicle(pair).all_connections}
    assert kinds == {"CBUSH 1": Damper, "CBUSH 2": Spring, "CBUSH 3": Mount}
    by_name = {c.name: c for c in read_vehicle(pair).all_connections}
    assert by_name["CBUSH 2"].rigid == ("x",)
    assert by_name["CBUSH 1"].bodies == ("upper", GROUND)
    np.testing.assert_allclose(by_name["CBUSH 3"].points[0] * 1000, place(22))


CBUSH = "CBUSH,1,7,1,2,,,,0"


@pytest.mark.parametrize(
    ("cards", "expected"),
    [
        ([PBUSH, CBUSH], "found no GRID"),
        ([*TWO, CBUSH], "CBUSH 1: property 7: is no PBUSH of the file; there are none"),
        ([*TWO, PBUSH, "CBUSH,1,7,1,5,,,,0"], "CBUSH 1: grid 5: is not in the file"),
        ([*TWO, PBUSH, "CBUSH,1,7,1,2,,,,4"], "CBUSH 1: coordinate system 4: is not in the file"),
        ([*TWO, PBUSH, "CBUSH,1,7,1,2,5"], "CBUSH 1: grid 5: is not in the file"),
        ([*TWO, PBUSH, "CBUSH,1,7,1,2,1.,0.,0."], "is along its line, expected across"),
        ([*TWO, PBUSH, "CBUSH,1,7,1,2,nan,0.,0."], "its vectors have values that are not finite"),
        ([*TWO, PBUSH, "CBUSH,1,7,1,2,1.+300,0.,0."], "its vectors have values that are not finite"),
        ([*TWO, PBUSH, "CBUSH,1,7,1,1"], "expected a CID"),
        ([*TWO, PBUSH, "CBUSH,1,7,1"], "expected a CID"),
        ([*TWO, PBUSH, CBUSH, ",1.5"], "S: found 1.5, expected 0 to 1"),
        ([*TWO, PBUSH, CBUSH, CBUSH], "element 1: is there 2 times"),
        ([*TWO, PBUSH, "CBUSH,one,7,1,2"], "found 'one', expected a whole number"),
        ([*TWO, "PBUSH,7,K,soft", CBUSH], "PBUSH 7: found 'soft', expected a number"),
        ([*TWO, "PBUSH,7,K,-3.", CBUSH], "PBUSH 7: K1: found -3, expected zero or more"),
        ([*TWO, "PBUSH,7,K,nan", CBUSH], "its rates have values that are not finite"),
        ([*TWO, "PBUSH,7,KMAG,3.", CBUSH], "line 1 of the card: found 'KMAG', expected lines K"),
        (
            [*TWO, PBUSH, ",B,.05,.05,.05", CBUSH],
            "PBUSH 7: line 2 of the card: found '.05' after 'B', which is a field early",
        ),
        ([*TWO, "PBUSH,7,,3.", CBUSH], "without K, B or GE"),
        ([*TWO, PBUSH, "PBUSH,7,K,3.", CBUSH], "PBUSH 7: is there twice, and not alike"),
        ([*TWO, PBUSH, "PBUSHT,7,K,21", CBUSH], "table 21: is no TABLED1"),
        (
            [*TWO, PBUSH, "PBUSHT,7,KSCALE,21", CBUSH],
            "of the card: found 'KSCALE', expected lines K, B",
        ),
        (
            [*TWO, PBUSH, "PBUSHT,7,K,21", CBUSH, "TABLED1,21", ",1.,2.,3.,4.,ENDT"],
            "is from 1 to 3 Hz",
        ),
        (
            [*TWO, PBUSH, "PBUSHT,7,K,21", CBUSH, "TABLED1,21", ",1.,2.,ENDT"],
            "expected two or more points",
        ),
        ([*TWO, "CELAS1,1,3,1,1,2,1"], "CELAS1 1: property 3: is no PELAS"),
        ([*TWO, "CELAS2,1,3.,1,1,2,2"], "which is another direction; expected the same"),
        ([*TWO, "CELAS2,1,3.,1,1,2,4"], "which is another direction; expected the same"),
        ([*TWO, "CELAS2,1,3.,1,7"], "found the component 7, expected 1 to 6"),
        ([*TWO, "CELAS2,1,3."], "names no grid"),
        ([*TWO, "CELAS2,1,3.,1"], "found the component 0, expected 1 to 6"),
        ([*TWO, "CELAS2,1,-3.,1,1"], "expected zero or more"),
    ],
)
def test_a_bad_file_is_refused_with_its_card(read, cards, expected):
    with pytest.raises(VehicleError) as error:
        read(*cards, frequency=15.0)
    assert "joints.bdf" in str(error.value)
    assert expected in str(error.value)


def test_grids_that_no_body_is_at_and_attachments_elsewhere_are_refused(pair, capsys, deck):
    def refused(cards, *options):
        assert put(deck(*cards), pair, *options) == 2
        return capsys.readouterr().err.splitlines()[-1]

    far = grids([900], [[5000, 0, 0]])
    text = refused([*far, PBUSH, "CBUSH,1,7,900,,,,,0"])
    assert "CBUSH 1, GA 900: no two bodies have attachments within 100 mm of it" in text
    moved = grids([11], [[300, 0, 0]])
    text = refused([*moved, PBUSH, "CBUSH,1,7,11,,,,,0"])
    assert "the attachment '11' of" in text
    assert "300 mm from there; is the body moved" in text
    near = grids([900], [place(11)])
    assert "are equally near; name the bodies" in refused([*near, PBUSH, "CBUSH,1,7,900,,,,,0"])
    assert "unknown body 'roof'" in refused(
        [*near, PBUSH, "CBUSH,1,7,900,,,,,0"], "--bodies", "roof", "lower"
    )


def test_a_grid_that_is_held_is_the_ground(pair, networks):
    lines = ["name,group,node 1,body 1,body 2,kx [N/mm],ky [N/mm],kz [N/mm]"]
    lines += [f"m{n},M,{n},upper,ground,10,20,30" for n in ATTACHED]
    second = there_and_back(lines, pair, networks, "--bodies", "upper", "lower")
    assert {mount.bodies for mount in second.mounts} == {("upper", GROUND)}


def test_grids_that_are_held_unless_they_say_otherwise_are_the_ground_too(read):
    usual = ["GRDSET,,,,,,,123456", "GRID,3,,0.,0.,0.,,4", PBUSH]
    (found,), _ = read(*TWO, *usual, "CBUSH,1,7,3,2,,,,0")
    assert [end.body for end in found.ends] == ["", GROUND]


def test_superelements_that_are_left_out_are_told(read):
    _, notes = read(*TWO, PBUSH, CBUSH, "BEGIN SUPER=1", "CBUSH,9,7,1,2,,,,0")
    assert notes == ["1 superelements that the input file has are left out"]


def test_springs_that_are_near_no_attachment_are_left_out_and_told(pair, capsys, deck):
    inner = grids([900, 901], [[5000, 0, 0], [5000, 0, 10]])
    inner_springs = ["CBUSH,2,7,900,901,,,,0", "CELAS2,3,5.,900,1,901,1"]
    mounts = ["CBUSH,1,7,11,1011,,,,0", "CBUSH,4,7,22,1022,,,,0", *inner_springs]
    path = deck(*grids(LABELS, CORNERS), *grids(LABELS + 1000, CORNERS), *inner, PBUSH, *mounts)
    assert put(path, pair) == 0
    assert [c.name for c in read_vehicle(pair).all_connections] == ["CBUSH 1", "CBUSH 4"]
    said = capsys.readouterr().err
    assert "CBUSH 2, CELAS 3: no body has an attachment near, and are left out" in said


def test_a_file_in_other_units_is_refused_even_if_a_spring_of_it_is_at_the_origin(pair, capsys, deck):
    at = CORNERS[list(LABELS).index(11)]
    cards = [*grids(LABELS + 1000, CORNERS - at), *grids(LABELS + 2000, CORNERS - at), PBUSH]
    cards += [f"CBUSH,{n},7,{n + 1000},{n + 2000},,,,0" for n in (11, 12, 22)]
    path = deck(*cards)
    before = (pair / "vehicle.toml").read_bytes()
    assert put(path, pair, units="m-kg-s") == 2
    assert "joints.bdf: 2 of 3 springs have no attachment of a body near" in capsys.readouterr().err
    assert (pair / "vehicle.toml").read_bytes() == before


def test_a_file_stands_in_the_vehicle_as_its_pose_says(pair, deck):
    """By grids whose places in the vehicle are known."""
    turn = Rotation.from_euler("zx", [30, 50], degrees=True).as_matrix()
    there = (CORNERS - [500, 20, 30]) @ turn.T
    cards = [*grids(LABELS, there), "PBUSH,7,K,10.,20.,30.", "CBUSH,1,7,11,,,,,0", ",,0,5.,0.,0."]
    path = deck(*cards)
    pose = "; ".join(f"{n}={','.join(map(str, place(n)))}" for n in (11, 12, 13, 23))
    assert put(path, pair, "--bodies", "upper", "ground", "--pose", pose) == 0
    (mount,) = read_vehicle(pair).mounts
    np.testing.assert_allclose(1000 * mount.points[0], place(11) + turn.T @ [5, 0, 0], atol=1e-9)
    K = mount.axes.T * mount.stiffness @ mount.axes
    np.testing.assert_allclose(K, turn.T @ np.diag([10e3, 20e3, 30e3]) @ turn, atol=1e-4)


def test_springs_of_a_file_that_is_listed_are_listed_in_its_own_units(capsys, deck):
    path = deck(*TWO, PBUSH, CBUSH)
    assert main(["import", str(path)]) == 0
    said = capsys.readouterr()
    assert "joints.bdf: has CBUSH or CELAS; --output and --units put" in said.err
    springs = said.out.split("Its springs, in its own units:")[1]
    assert re.search(r"CBUSH 1 +PBUSH 7 +10, 20, 30 +4000, 5000, 6000 +0", springs)


def test_springs_that_cannot_be_read_do_not_keep_a_file_from_being_listed(capsys, deck):
    path = deck(*TWO, CBUSH)
    assert main(["import", str(path)]) == 0
    said = capsys.readouterr()
    assert "2 nodes" in said.out
    assert "property 7: is no PBUSH of the file" in said.err


def test_a_grid_with_the_number_of_an_attachment_elsewhere_is_on_the_one_that_is_there(pair, deck):
    """Grids of an exported deck are numbered from one, as nodes are."""
    path = deck(*grids([11, 22], [place(14), place(14)]), PBUSH, "CBUSH,1,7,11,22,,,,0")
    assert put(path, pair) == 0
    (mount,) = read_vehicle(pair).mounts
    assert set(mount.bodies) == {"upper", "lower"}
    np.testing.assert_allclose(1000 * mount.points, [place(14)] * 2)


def test_units_are_asked_for(pair, capsys, deck):
    path = deck(*TWO, PBUSH, CBUSH)
    assert main(["import", str(path), "--output", str(pair)]) == 2
    assert "doesn't say its units, and they are not guessed" in capsys.readouterr().err
