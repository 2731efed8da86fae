"""How much too high frequencies are without residual vectors, held against full matrices."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from small_meshes import STEEL, plate, shell
from two_sheets import direct_frequencies, joined, mount_stiffness, sheets

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.truncation import modes_only
from modeviz.dynamics.truncation_gap import (
    TruncationGap,
    on_trial_mounts,
    stiff_connections,
    truncation_gap,
)
from modeviz.fem.attachments import OnNode
from modeviz.fem.component import flexible_body
from modeviz.fem.matrices import assemble as assemble_mesh
from modeviz.fem.mesh import ShellSection
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.report.stiff_connections import stiff_record, stiff_table
from modeviz.report.truncation import gap_words, import_notes, truncation_doubts
from modeviz.vehicle.connections import Spring
from modeviz.vehicle.residual_estimate import estimate_residuals
from modeviz.vehicle.residuals import with_residual_compliance
from modeviz.vehicle.vehicle import Vehicle


@pytest.fixture(scope="module")
def exact():
    """Frequencies by the full matrices, by the stiffness of mounts."""
    return {part: direct_frequencies(mount_stiffness(part)) for part in (0.05, 0.3, 1.5)}


def coupled(vehicle, below_hz):
    found = solve_modes(assemble(vehicle), below_hz=below_hz).frequency_hz
    return found[found > 0.5]


@pytest.mark.parametrize("part", [0.05, 0.3, 1.5])
@pytest.mark.parametrize(("n_floor", "n_roof"), [(24, 24), (20, 40), (40, 30), (30, 60)])
def test_coupling_with_residual_vectors_is_that_of_the_full_matrices(exact, part, n_floor, n_roof):
    floor, roof = (s.body(n, True) for s, n in zip(sheets(), (n_floor, n_roof), strict=True))
    vehicle = joined(floor, roof, mount_stiffness(part))
    below = 0.5 * min(b.natural_frequency_hz[b.n_normal - 1] for b in (floor, roof))
    found = coupled(vehicle, below)
    np.testing.assert_allclose(found, exact[part][6 : 6 + len(found)], rtol=1e-6)
    assert len(found) >= 15
    assert truncation_gap(vehicle) is None
    assert not list(truncation_doubts(vehicle))


@pytest.mark.parametrize("part", [0.05, 0.3, 1.5])
@pytest.mark.parametrize(("n_floor", "n_roof"), [(24, 24), (20, 40), (40, 30), (30, 60)])
def test_without_them_it_is_off_by_what_is_said_within_a_factor_of_two(exact, part, n_floor, n_roof):
    floor, roof = (s.body(n) for s, n in zip(sheets(), (n_floor, n_roof), strict=True))
    vehicle = joined(floor, roof, mount_stiffness(part))
    gap = truncation_gap(vehicle)
    found = coupled(vehicle, gap.below_hz)
    true = (found / exact[part][6 : 6 + len(found)] - 1).max()
    assert 0.5 < gap.change / true < 2
    assert gap.bodies == ("floor", "roof")
    assert true / gap.within < gap.change < true * gap.within


def test_given_compliance_is_added_exactly_and_to_what_holds_there_alone():
    body = sheets()[0].body(20)
    given = np.array([1e-6, 0.0, 3e-5])
    softer = with_residual_compliance(body, {"floor 2": given})
    assert softer.n_residuals == 2
    for name, expected in (("floor 2", given), ("floor 1", np.zeros(3))):
        np.testing.assert_allclose(
            softer.residual_compliance(name), np.diag(expected), rtol=1e-12, atol=0
        )
    assert softer.mass == pytest.approx(body.mass)


def test_a_spring_on_given_compliance_is_a_spring_in_series_with_it():
    """1/k + R in place of 1/k, while R is static."""
    body, R, k = sheets()[0].body(20), 4e-5, 2e4
    place = np.tile(body.attachments[0].position, (2, 1))

    def frequencies(body, stiffness):
        spring = Spring("s", "s", ("floor", "ground"), place, stiffness=np.array([0, 0, stiffness]))
        return coupled(replace(on_trial_mounts(body), connections=(spring,)), 60.0)

    given = with_residual_compliance(body, {"floor 0": np.array([0, 0, R])})
    found, expected = frequencies(given, k), frequencies(body, 1 / (1 / k + R))
    np.testing.assert_allclose(found, expected, rtol=1e-5)
    assert (frequencies(body, k)[: len(found)] / found).max() > 1.01


def test_connections_that_are_nearly_as_stiff_as_a_body_are_named():
    floor, roof = (sheet.body(24) for sheet in sheets())
    stiffness = np.full((4, 3), 10.0)
    local = 1 / sheets()[0].compliance[1, 2]
    stiffness[1, 2] = 0.2 * local
    vehicle = joined(floor, roof, stiffness)
    named = [s for s in stiff_connections(vehicle) if s.body == "floor"]
    assert [(s.connection, s.attachment, s.direction) for s in named] == [("mount 1", "floor 1", "z")]
    assert named[0].local_stiffness == pytest.approx(local, rel=0.1)
    said = next(iter(truncation_doubts(vehicle)))
    assert (
        "connections are stiffer than a tenth of it: 'mount 1' (z); the most, 'mount 1' along z" in said
    )


def many_on_a_floor(n: int, stiffness: float) -> Vehicle:
    """A sheet on so many springs at each of its points, each a little softer than the last."""
    body = sheets()[0].body(24)
    springs = tuple(
        Spring(
            f"spring {n * i + j}",
            "s",
            ("floor", "ground"),
            np.tile(a.position, (2, 1)),
            stiffness=np.array([0, 0, stiffness * (1 - 0.01 * (n * i + j))]),
        )
        for i, a in enumerate(body.attachments)
        for j in range(n)
    )
    return replace(on_trial_mounts(body), connections=springs)


def test_of_many_stiff_connections_the_stiffest_are_named_and_the_others_counted():
    vehicle = many_on_a_floor(6, 1e7)
    stiff = {s.connection: s.stiffness / s.local_stiffness for s in stiff_connections(vehicle)}
    order = sorted(stiff, key=stiff.__getitem__, reverse=True)
    assert len(order) == 24
    said = next(iter(truncation_doubts(vehicle)))
    names = ", ".join(f"'{name}' (z)" for name in order[:3])
    assert f"stiffer than a tenth of it: {names} and 21 more; the most, '{order[0]}' along z" in said
    assert len(said) < 350
    lines = stiff_table(vehicle).splitlines()
    assert [line.split("  ")[0] for line in lines[2:-1]] == order[:20]
    assert lines[-1] == "and 4 more; --json has all"
    assert stiff_table(many_on_a_floor(6, 10.0)) == ""
    assert len(stiff_record(vehicle)) == 24


def test_where_words_name_all_stiff_connections_there_is_no_table():
    vehicle = many_on_a_floor(6, 1e7)
    few = replace(vehicle, connections=vehicle.connections[:3])
    assert stiff_table(few) == ""
    assert len(stiff_record(few)) == 3


def test_a_rigid_connection_is_stiff_beside_any_body():
    body = sheets()[0].body(24)
    place = np.tile(body.attachments[0].position, (2, 1))
    bolt = Spring("bolt", "b", ("floor", "ground"), place, rigid=("x", "z"))
    vehicle = replace(on_trial_mounts(body), connections=(bolt,))
    assert [s.direction for s in stiff_connections(vehicle)] == ["x", "z"]
    assert "'bolt' (x, z); the most, 'bolt' along x, is rigid" in next(truncation_doubts(vehicle))


def test_an_import_says_what_its_truncation_does_and_how_many_modes_are_wanted():
    lacks, fewer = import_notes(sheets()[0].body(14))
    assert "lacks residual vectors" in lacks
    assert "order of magnitude" in lacks
    assert "without the last 2 of its 8 elastic modes frequencies rise by up to" in fewer
    assert not list(import_notes(sheets()[0].body(14, with_residuals=True)))


def test_on_trial_mounts_an_import_says_what_it_is_off_mostly_within_a_factor_of_two():
    """The exact one has 150 modes and residual vectors at its attachments."""
    ratios = []
    for sheet in sheets():
        for n_modes in range(18, 82, 7):
            vehicle = on_trial_mounts(sheet.body(n_modes))
            gap = truncation_gap(vehicle)
            ratios.append(gap.change / too_high(vehicle, gap.below_hz))
    assert len(ratios) == 20
    assert np.sum(np.abs(np.log2(ratios)) < 1) >= 18
    assert np.abs(np.log2(ratios)).max() < 1.5


@pytest.mark.parametrize(("which", "n_modes"), [(0, 7), (0, 9), (1, 9), (1, 10)])
def test_with_as_many_modes_as_are_wanted_it_is_off_by_half_a_per_cent(which, n_modes):
    """Within a factor of two, and not with those that it had."""
    body = sheets()[which].body(n_modes)
    vehicle, (_, fewer) = on_trial_mounts(body), import_notes(body)
    wanted = int(re.search(r"for 0.5% about (\d+) are wanted", fewer)[1])
    below = truncation_gap(vehicle).below_hz
    more = replace(vehicle, bodies=(sheets()[which].body(6 + wanted),))
    assert too_high(more, below) < 0.01
    assert wanted > n_modes - 6


@cache
def _exact(name):
    return next(sheet.body(150, True) for sheet in sheets() if sheet.name == name)


def too_high(vehicle, below_hz):
    """By what part frequencies of a sheet on mounts are, at most."""
    (body,) = vehicle.bodies
    exact = _exact(body.name)
    found = coupled(vehicle, below_hz)
    return (found / coupled(replace(vehicle, bodies=(exact,)), below_hz)[: len(found)] - 1).max()


def test_trial_mounts_are_a_tenth_as_stiff_as_the_body_across():
    nodes = assemble_mesh(plate(6)).nodes
    points = [OnNode(f"{i}", nodes[i], node=i) for i in (8, 26, 40)]
    body = flexible_body("plate", "frame", "plate", plate(6), points, 60, 0.01)
    phi = np.array([a.shapes[2, 6:] for a in body.attachments])
    expected = 0.1 / np.sum(phi**2 / body.omega_n_squared[6:], axis=1)
    for spring, k in zip(on_trial_mounts(body).connections, expected, strict=True):
        np.testing.assert_allclose(spring.stiffness, k, rtol=0.01)


def test_the_truck_without_residual_vectors_is_off_by_what_is_said_within_a_factor_of_two():
    truck = read_vehicle(builtin_vehicle())
    without = replace(modes_only(truck), connections=truck.connections)
    assert not list(truncation_doubts(truck))
    gap = truncation_gap(without)
    found = coupled(without, gap.below_hz)
    true = (found / coupled(truck, 2 * gap.below_hz)[: len(found)] - 1).max()
    assert true > 0.05
    assert 0.5 < gap.change / true < 2
    assert len(list(truncation_doubts(without))) == 5


def test_residual_vectors_of_some_attachments_leave_the_others_lacking():
    body = sheets()[0].body(24)
    estimate = estimate_residuals(body).compliance
    some = with_residual_compliance(body, {"floor 0": estimate[0]})
    left = estimate_residuals(some).compliance
    assert not left[0].any()
    np.testing.assert_allclose(left[1:], estimate[1:])


@pytest.mark.parametrize(
    ("within", "said"),
    [
        (2.0, "up to about 3 % (at 9.5 Hz; an estimate within a factor of two)"),
        (4.0, "up to about 3 % (at 9.5 Hz; an estimate, between 0.75 % and 12 %)"),
        (10.0, "(at 9.5 Hz; these modes tell the order of magnitude alone; it is at least 0.5 %)"),
    ],
)
def test_it_is_said_how_well_a_gap_is_known(within, said):
    assert said in gap_words(TruncationGap(("cab",), 0.03, 9.5, 30.0, within))


@pytest.mark.parametrize("within", [2.0, 4.0, 10.0])
def test_a_gap_that_is_little_at_its_upper_end_is_too_little_to_matter(within):
    little, more = (
        TruncationGap(("cab",), part * 0.005 / within, 9.5, 30.0, within) for part in (0.9, 1.1)
    )
    assert gap_words(little).endswith("are too high by less than 0.5 %, too little to matter")
    assert "(at 9.5 Hz; " in gap_words(more)


def test_fewer_than_a_dozen_modes_or_uneven_bodies_tell_the_order_of_magnitude():
    vehicle = on_trial_mounts(sheets()[0].body(6 + 40))
    assert truncation_gap(vehicle).within == 2
    assert truncation_gap(on_trial_mounts(sheets()[0].body(6 + 11))).within == 10
    (body,) = vehicle.bodies
    some = np.arange(len(body.nodes)) % 2 == 0
    shapes = body.shapes.copy()
    shapes[some, :, 6:26] *= 0.05
    assert truncation_gap(replace(vehicle, bodies=(replace(body, shapes=shapes),))).within == 10


def test_a_mount_that_is_stiff_in_the_plane_of_a_sheet_makes_the_gap_doubtful():
    """No mode moves the sheet there, so nothing is known of how it gives way."""
    n = 40
    body = body_of_plate(n)
    k = on_trial_mounts(body).connections[0].stiffness
    for factor, known in (([1, 1, 1], True), ([300, 300, 1], False)):
        springs = tuple(replace(c, stiffness=k * factor) for c in on_trial_mounts(body).connections)
        gap = truncation_gap(replace(on_trial_mounts(body), connections=springs))
        assert (gap.within < 10) == known


def body_of_plate(n_elastic):
    mesh = shell(lambda u, v: (1.1 * u, 0.8 * v, 0.0), 20, 14, ShellSection(0.003, **STEEL))
    nodes = assemble_mesh(mesh).nodes
    points = [OnNode(f"{i}", nodes[i], node=i) for i in (40, 131, 222)]
    return flexible_body("plate", "frame", "plate", mesh, points, 6 + n_elastic, 0.01).truncated(
        6 + n_elastic
    )
