"""Residual vectors in universal files come back as what they were."""

import re
from dataclasses import replace

import numpy as np
import pytest
import pyuff
from two_sheets import joined, mount_stiffness, sheets
from universal_files import nodes_2411, shape_55, shape_2414

from modeviz.cli import main
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.files import read_vehicle
from modeviz.formats.universal import read_universal
from modeviz.report.truncation import import_notes
from modeviz.study.study import Study
from modeviz.vehicle.residuals import with_residual_compliance

N_MODES = 16
"""Of a sheet, six rigid."""

DIGITS = 5.1e-6
"""Relative: half of the sixth digit of a number."""

PLACES = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])


def with_all():
    """A sheet with residual vectors for all of its attachments."""
    return sheets()[0].body(N_MODES, with_residuals=True)


def with_one():
    """A sheet with one residual vector, across it at its first attachment."""
    return with_residual_compliance(sheets()[0].body(N_MODES), {"floor 0": np.array([0, 0, 1e-6])})


def without():
    return sheets()[0].body(N_MODES)


def words(note):
    """A notice without its percentages: the file has the attachments' nodes beside those of the mesh,
    and what is estimated of modes left out goes by how many nodes share the mass."""
    return re.sub(r"[\d.]+ %", "some %", note)


def exported(tmp_path, floor, ending):
    """The vehicle of two sheets, and the file of the first of them."""
    vehicle = joined(floor, sheets()[1].body(N_MODES), mount_stiffness(0.1))
    return vehicle, Study(vehicle).export(tmp_path / f"floor{ending}").path


@pytest.mark.parametrize("ending", [".unv", ".uff"])
@pytest.mark.parametrize("body", [with_all, with_one, without])
def test_a_body_out_and_in_has_the_same_kinds_of_modes_and_the_same_notice(
    tmp_path, capsys, body, ending
):
    before = body()
    vehicle, path = exported(tmp_path, before, ending)
    attach = [word for i in range(4) for word in ("--attach", f"floor {i}={i + 1}")]
    assert main(["import", str(path), "--output", str(tmp_path / "again"), *attach]) == 0
    said = capsys.readouterr()

    after = read_vehicle(tmp_path / "again").body("floor")
    kinds = [(b.n_rigid, b.n_normal, b.n_residuals) for b in (before, after)]
    assert kinds[0] == kinds[1]
    assert [words(n) for n in import_notes(after)] == [words(n) for n in import_notes(before)]
    assert ("lacks residual vectors" in said.err) == (body is without)
    swapped = replace(vehicle, bodies=(after, *vehicle.bodies[1:]))
    found, expected = (solve_modes(assemble(each)).frequency_hz[6:] for each in (swapped, vehicle))
    np.testing.assert_allclose(found, expected, rtol=20 * DIGITS)


def test_a_list_of_modes_says_which_are_residual_vectors(tmp_path, capsys):
    _, path = exported(tmp_path, with_one(), ".unv")
    assert main(["import", str(path)]) == 0
    said = capsys.readouterr().out
    assert [line.split()[0] for line in said.splitlines() if "residual vector" in line] == ["17,"]


def test_other_programs_read_a_residual_vector_as_a_mode(tmp_path):
    _, path = exported(tmp_path, with_one(), ".uff")
    modes = [one for one in pyuff.UFF(str(path)).read_sets() if one["type"] == 55]
    marks = [mode["id4"].strip() for mode in modes]
    assert marks == ["NONE"] * N_MODES + ["RESIDUAL VECTOR"]
    assert {mode["analysis_type"] for mode in modes} == {2}


def test_a_residual_vector_goes_after_all_modes(tmp_path):
    shapes = np.eye(9).reshape(9, 3, 3)
    labels = [1, 2, 3]
    text = nodes_2411(labels, PLACES)
    for i, (hertz, title) in enumerate([(9.0, " Residual vector "), (30.0, "NONE"), (20.0, "NONE")]):
        text += shape_55(labels, shapes[i], hertz, titles=title)
    path = tmp_path / "marked.unv"
    path.write_text(text)
    modes = read_universal([path]).modes
    assert modes.frequency_hz.tolist() == [20.0, 30.0, 9.0]
    assert modes.n_residuals == 1


def test_a_body_that_is_called_a_residual_vector_has_none(tmp_path):
    path = tmp_path / "named.unv"
    titled = shape_55([1, 2, 3], np.eye(3), 9.0, titles="residual vector: mode 7, mode 1")
    path.write_text(nodes_2411([1, 2, 3], PLACES) + titled)
    assert read_universal([path]).modes.n_residuals == 0


@pytest.mark.parametrize(
    ("analysis", "name"), [(10, "Craig-Bampton constraint modes"), (11, "equivalent attachment modes")]
)
def test_attachment_modes_without_a_frequency_are_left_out_and_named(tmp_path, analysis, name):
    mode = shape_2414([1, 2, 3], np.eye(3), 9.0)
    other, n_changed = re.subn(rf"(?m)^{1:10d}{2:10d}{2:10d}", f"{1:10d}{analysis:10d}{2:10d}", mode)
    assert n_changed == 1
    path = tmp_path / "attached.unv"
    path.write_text(nodes_2411([1, 2, 3], PLACES) + mode + other + other)
    component = read_universal([path])
    assert component.n_modes == 1
    (note,) = component.notes
    assert note == f"data sets left out, which are no part of modes: 2 of 2414 ({name})"
