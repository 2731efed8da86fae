"""Mounts moved along a flexible sheet, against the sheet with an attachment where they are moved to."""

from dataclasses import replace

import numpy as np
import pytest
from block_on_a_sheet import (
    HELD,
    N_U,
    N_V,
    A,
    B,
    at,
    beyond,
    matrices,
    moved,
    near,
    on_a_block,
    place,
    sheet,
)
from small_meshes import STEEL, shell

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.fem.attachments import OnNode
from modeviz.fem.component import body_from_matrices
from modeviz.fem.matrices import assemble as assemble_mesh
from modeviz.fem.mesh import ShellSection
from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.placement import Placement, with_placements
from modeviz.vehicle.residuals import modal_compliance

WITHIN = 150.0
"""Hz: of 50 modes up to 500 Hz."""


def frequencies(vehicle):
    return solve_modes(assemble(vehicle), below_hz=WITHIN).frequency_hz


def modes_alone(body):
    return body.truncated(body.n_normal)


def test_by_modes_alone_a_moved_mount_is_one_imported_there():
    here, there = (on_a_block(modes_alone(sheet(at(node))), place(node)) for node in (A, B))
    found, expected = frequencies(moved(here, place(B))), frequencies(there)
    assert len(expected) > 12
    assert found == pytest.approx(expected, rel=2e-6)  # the nodes' shapes are in single precision
    assert frequencies(here) != pytest.approx(expected, rel=0.01)


def test_without_its_residual_vectors_modes_well_inside_the_range_are_within_a_thousandth():
    here, there = (on_a_block(sheet(at(node)), place(node)) for node in (A, B))
    off = frequencies(moved(here, place(B))) / frequencies(there) - 1
    assert np.abs(off).max() < 1e-3


def test_moved_to_an_attachment_it_is_as_exact_as_that_is():
    body = sheet(at(A), near(B, "other"))
    other = body.attachment("other").position
    found, expected = (
        frequencies(v) for v in (moved(on_a_block(body, place(A)), other), on_a_block(body, other))
    )
    assert found == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("points", "start"),
    [((at(A),), (0, 0, 0)), ((near(A),), (0, 0, 0)), ((near(A),), (0.03, 0, 0.05)), ((), (0, 0, 0.05))],
    ids=["node", "mean", "arm of a mean", "arm of another"],
)
def test_mounts_move_away_without_a_step(points, start):
    body = sheet(*points)
    held = body.attachments[-1].position + start
    vehicle = on_a_block(body, held)
    before = frequencies(vehicle)
    for offset, change in ((1e-9, 1e-7), (1e-4, 1e-3)):
        assert frequencies(moved(vehicle, beyond(held, offset, 0, 0))) == pytest.approx(
            before, rel=change
        )


def test_between_nodes_shapes_are_those_of_a_finer_mesh():
    """Of bending waves of 12 elements and more, in the middle of an element of the coarse one."""

    def body(n_u, n_v):
        section = ShellSection(0.004, **STEEL)
        mesh = assemble_mesh(shell(lambda u, v: (1.1 * u, 0.8 * v, 0.0), n_u, n_v, section))
        middle = int(np.argmin(np.linalg.norm(mesh.nodes - [0.525, 0.375, 0.0], axis=1)))
        point = OnNode("mount", mesh.nodes[middle], middle)
        return body_from_matrices("sheet", "frame", "sheet", mesh, (point,), 14, 0.01)

    coarse, fine = body(N_U, N_V), body(2 * N_U, 2 * N_V)
    there = fine.attachments[0]
    vehicle = on_a_block(coarse, coarse.attachments[0].position, corners=())
    held = moved(vehicle, there.position).body("sheet").attachments[-1]
    found, expected = (np.abs(a.shapes[2, 6:14]) for a in (held, there))
    assert found == pytest.approx(expected, abs=0.03 * expected.max())


def test_what_hangs_beside_its_new_place_moves_as_before():
    vehicle = on_a_block(sheet(at(A)), place(A))
    near_b = beyond(place(B), 0.02, 0.0, 0.03)
    point = ResponsePoint("point", "sheet", beyond(place(HELD[0]), 0.05, 0.02, 0.0))
    vehicle = replace(vehicle, response_points=(point,))
    after = moved(vehicle, point.position)
    before, now = (assemble(v).motion("sheet", point.position) for v in (vehicle, after))
    np.testing.assert_allclose(now, before, atol=1e-12)
    assert len(moved(vehicle, near_b).body("sheet").attachments) == len(HELD) + 2


def test_a_place_off_the_body_is_refused_in_a_sentence():
    vehicle = on_a_block(sheet(at(A)), place(A))
    words = (
        r"'m': \[.*\] m is off body 'sheet': 0\.20 m from the nearest node, expected at most 0\.10 m"
    )
    with pytest.raises(VehicleError, match=words):
        moved(vehicle, beyond(place(B), 0, 0, 0.2))
    bare = replace(sheet(at(A)), nodes=np.zeros((0, 3)), shapes=np.zeros((0, 6, sheet(at(A)).n_modes)))
    bare_vehicle = on_a_block(bare, place(A))
    held = moved(bare_vehicle, beyond(place(A), 0.05, 0, 0))
    assert "m" in [a.name for a in held.body("sheet").attachments]
    with pytest.raises(VehicleError, match="from where it was, as the body has no nodes"):
        moved(bare_vehicle, beyond(place(A), 0.2, 0, 0))


def test_the_compliance_that_is_missing_is_said_within_a_factor_of_four():
    few = sheet(at(A)).truncated(30)
    vehicle = on_a_block(few, place(A))
    (note,) = told(moved(vehicle, place(B)))
    assert note.startswith("body 'sheet' has no residual vectors of its own where mounts 'm' are moved")
    said = float(note.split("about ")[1].split(" µm/N")[0].split(", ")[2]) * 1e-6
    whole = body_from_matrices("sheet", "frame", "sheet", matrices(), (at(B),), 250, 0.01)
    true = modal_compliance(whole)[0, 2] - modal_compliance(sheet(at(B)).truncated(30))[-1, 2]
    assert 0.25 < said / true < 4


def test_nothing_is_missing_where_a_mount_is_moved_to_an_attachment():
    assert not told(moved(on_a_block(sheet(at(A), at(B, "b")), place(A)), place(B)))


def told(vehicle):
    return [note for note in vehicle.notes if "residual vectors" in note]


def test_the_folder_of_a_vehicle_with_moved_mounts_gives_its_frequencies(tmp_path):
    after = moved(on_a_block(sheet(at(A)), place(A)), beyond(place(B), 0.01, 0.02, 0.03))
    write_vehicle(after, tmp_path / "moved")
    again = read_vehicle(tmp_path / "moved")
    assert again.notes[: len(after.remarks)] == again.remarks == after.remarks
    assert frequencies(again) == pytest.approx(frequencies(after), rel=1e-9)
    found, expected = (assemble(vehicle).stiffness for vehicle in (again, after))
    np.testing.assert_allclose(found, expected, atol=1e-12 * np.abs(expected).max())


def test_what_a_folder_keeps_of_moved_mounts_is_what_bodies_lack_where_they_are_now(tmp_path):
    few = on_a_block(sheet(at(A)).truncated(30), place(A))
    once = moved(few, place(B))
    assert any("mounts 'm' are moved by" in note for note in once.notes)
    (kept,) = once.remarks
    assert "residual vectors of its own where mounts 'm' are moved to" in kept
    write_vehicle(once, tmp_path / "once")
    again = with_placements(read_vehicle(tmp_path / "once"), {"m": Placement(offset=(0.02, 0.01, 0.0))})
    (now,) = again.remarks
    assert "mounts 'm' are moved to" in now
    assert now != kept
