"""What the page of bodies shows of components and of bodies."""

from dataclasses import replace

import numpy as np
import pytest
from looked_at import CORNERS, MM_T_S, heaving_and_twisting, plate

from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.shapes.motion import displacement
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.viewer.inspection.subject import subject_of_body, subject_of_component


def at_corners(subject, moved):
    """What is said of the plate's corners, in their order."""
    sizes = np.linalg.norm(
        subject.drawn.vertices[:, None] - subject.drawn.vertices.max() * CORNERS / 2000, axis=2
    )
    return moved[sizes.argmin(axis=0)]


@pytest.mark.parametrize("kind", [float, complex])
def test_corners_move_as_the_file_says(kind):
    shapes = heaving_and_twisting(kind)
    subject = subject_of_component(plate(shapes), "plate", MM_T_S)
    for mode in (0, 1):
        moved = at_corners(subject, displacement(subject.shapes, subject.coordinates(mode)))
        np.testing.assert_allclose(moved, 1e-3 * shapes[:, :, mode], atol=1e-9)


def test_a_rotation_is_that_of_the_file_whatever_the_units():
    """A tube's vertices stand off its line's nodes, and go along with their rotations."""
    turning = np.zeros((4, 3, 1))
    component = plate(turning)
    component.modes.shapes[:, 5, 0] = 0.5  # rad about z
    component = replace(component, elements={"line": np.array([[0, 1]])})
    subject = subject_of_component(component, "rod", MM_T_S)
    moved = displacement(subject.shapes, subject.coordinates(0))
    ends = np.array([[0, 0, 0], [2.0, 0, 0]])
    arms = (
        subject.drawn.vertices - ends[np.abs(subject.drawn.vertices[:, :1] - ends[:, 0]).argmin(axis=1)]
    )
    turned = np.cross([0, 0, 1.0], arms)  # the largest motion of a file is one
    np.testing.assert_allclose(moved, turned, atol=5e-5)  # the rod's other end has its little share
    assert np.abs(turned).max() > 1e-3


def test_what_has_no_units_is_drawn_one_large():
    subject = subject_of_component(plate(heaving_and_twisting()), "plate", None)
    assert np.ptp(subject.drawn.vertices, axis=0).max() == pytest.approx(1.0)
    assert "the file does not say them" in " ".join(subject.about)


def test_nodes_without_elements_are_drawn_as_points_that_move_along():
    component = replace(plate(heaving_and_twisting()), elements={})
    subject = subject_of_component(component, "points", MM_T_S)
    assert len(subject.drawn.vertices) == 6 * 4
    moved = displacement(subject.shapes, subject.coordinates(1)).reshape(4, 6, 3)
    middles = moved[:, :, 2].mean(axis=1)  # their corners turn about them
    np.testing.assert_allclose(middles, [1e-3, -1e-3, 1e-3, -1e-3], rtol=1e-3)


def test_motions_without_places_are_listed_and_not_drawn():
    component = plate(heaving_and_twisting())
    nowhere = replace(component, nodes=np.full((4, 3), np.nan), elements={})
    subject = subject_of_component(nowhere, "test", None)
    assert len(subject.drawn.vertices) == 0
    assert [mode.frequency_hz for mode in subject.modes] == [0.0, 20.0]


def test_the_first_mode_shown_deforms_it():
    assert subject_of_component(plate(heaving_and_twisting()), "plate", None).first_shown == 1


def test_it_says_whether_it_can_be_coupled():
    unknown = subject_of_component(plate(heaving_and_twisting()), "plate", MM_T_S)
    assert "cannot be coupled" in unknown.about[-1]
    assert "modal mass of 2 of its 2 modes" in unknown.about[-1]


def test_a_body_of_a_vehicle_is_seen_in_its_own_modes_with_its_attachments():
    vehicle = read_vehicle(builtin_vehicle())
    for body in vehicle.bodies:
        subject = subject_of_body(body)
        if not isinstance(body, FlexibleBody):
            assert not subject.modes
            continue
        assert len(subject.modes) == body.n_modes
        assert [m.kind for m in subject.modes].count("residual vector") == body.n_residuals
        assert subject.modes[subject.first_shown].frequency_hz == body.natural_frequency_hz[6]
        q = subject.coordinates(8)
        for mark, attachment in zip(subject.marks, body.attachments, strict=True):
            np.testing.assert_array_equal(mark.shapes @ q, attachment.shapes[:3, 8])


def test_a_surface_of_very_many_faces_is_drawn_coarser_and_says_so():
    n = 250
    q = np.arange(n * n).reshape(n, n)
    quads = np.stack([q[:-1, :-1], q[1:, :-1], q[1:, 1:], q[:-1, 1:]], axis=-1).reshape(-1, 4)
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
    component = replace(
        plate(heaving_and_twisting()),
        node_ids=q.ravel() + 1,
        nodes=np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1),
        elements={"quad": quads},
        modes=replace(
            plate(heaving_and_twisting()).modes,
            shapes=np.ones((n * n, 6, 2)),
        ),
    )
    subject = subject_of_component(component, "plate", MM_T_S)
    assert sum(len(patch.faces) for patch in subject.drawn.patches) <= 100_000
    assert f"Its surface has {2 * len(quads):,} faces; a coarser surface is drawn" in subject.about[-1]
