"""The units of a vehicle file hold for its arrays too, unless these say their own."""

from pathlib import Path

import numpy as np
import pytest
from folders import one_of_everything

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.schema.axes import axes_of
from modeviz.files.schema.conventions import Conventions
from modeviz.vehicle.bodies import FlexibleBody

MASSES = {"kg": 1.0, "t": 1000.0, "lbf s²/in": 0.45359237 * 9.80665 / 0.0254}
LENGTHS = {"m": 1.0, "mm": 1e-3, "in": 0.0254}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_vehicle(one_of_everything(), tmp_path / "a")
    return tmp_path / "a"


def cab(folder: Path) -> FlexibleBody:
    body = read_vehicle(folder).body("cab")
    assert isinstance(body, FlexibleBody)
    return body


def save_in(folder: Path, length: str, mass: str) -> None:
    """The cab's arrays as a solver gives them that computes in these units.

    Its M is in its unit of mass, and M of a rotation in mass length²; φᵀMφ = I all the same.
    """
    metre, kilogram = LENGTHS[length], MASSES[mass]
    path = folder / "bodies/cab.npz"
    with np.load(path) as archive:
        arrays = dict(archive)
    for name in ("attachment_positions", "nodes"):
        arrays[name] = arrays[name] / metre
    for name in ("attachment_shapes", "shapes"):
        arrays[name] = arrays[name] * np.sqrt(kilogram)
        arrays[name][:, 3:] *= metre
    np.savez(path, **arrays)


def edit(folder: Path, old: str, new: str) -> None:
    path = folder / "vehicle.toml"
    assert old in path.read_text("utf-8")
    path.write_text(path.read_text("utf-8").replace(old, new, 1), "utf-8")


def assert_same_arrays(found: FlexibleBody, expected: FlexibleBody) -> None:
    np.testing.assert_array_equal(found.omega_n_squared, expected.omega_n_squared)
    np.testing.assert_allclose(found.nodes, expected.nodes, rtol=1e-14)
    np.testing.assert_allclose(found.shapes, expected.shapes, rtol=1e-6)  # single precision
    for a, b in zip(found.attachments, expected.attachments, strict=True):
        np.testing.assert_allclose(a.position, b.position, rtol=1e-14)
        np.testing.assert_allclose(a.shapes, b.shapes, rtol=1e-14)


@pytest.mark.parametrize("mass", MASSES)
@pytest.mark.parametrize("length", LENGTHS)
def test_modes_in_their_own_units_are_the_same_body(folder, length, mass):
    expected = cab(folder)
    save_in(folder, length, mass)
    units = f'units = {{ length = "{length}", mass = "{mass}" }}\nmodes ='
    edit(folder, "modes =", units)
    assert_same_arrays(cab(folder), expected)


def test_modes_without_units_of_their_own_have_those_of_the_vehicle(folder):
    expected = cab(folder)
    path = folder / "vehicle.toml"
    text = path.read_text("utf-8").replace('\nmass = "kg"', '\nmass = "t"')
    path.write_text(text, "utf-8")
    save_in(folder, "m", "t")
    assert_same_arrays(cab(folder), expected)


def test_modal_mass_is_one_in_any_units():
    """A body of 2 t and 3e9 t mm² = 3e6 kg m²: in t, mm φ is 1/√2 and 1/√3e9."""
    shapes = np.zeros((6, 2))
    shapes[2, 0] = 1 / np.sqrt(2.0)
    shapes[4, 1] = 1 / np.sqrt(3e9)
    found = Conventions({"length": "mm", "mass": "t"}).shapes(shapes)
    assert found[2, 0] == pytest.approx(1 / np.sqrt(2000.0))
    assert found[4, 1] == pytest.approx(1 / np.sqrt(3e6))


def test_modes_without_rotations_have_units_too():
    whole = np.arange(12.0).reshape(6, 2)
    conventions = Conventions({"length": "mm", "mass": "t"}, axes_of("x forward, y right, z down"))
    np.testing.assert_array_equal(conventions.shapes(whole[:3]), conventions.shapes(whole)[:3])


@pytest.mark.parametrize(
    ("units", "words"),
    [
        ('{ length = "mmm" }', "flexible_body[0].units.length: unknown unit of length 'mmm'"),
        ('{ lenght = "mm" }', "units.lenght: unknown quantity 'lenght': did you mean 'length'?"),
        ('{ length = "kg" }', "units.length: unknown unit of length 'kg'"),
    ],
)
def test_wrong_units_of_modes_are_explained(folder, units, words):
    edit(folder, "modes =", f"units = {units}\nmodes =")
    with pytest.raises(VehicleError) as caught:
        read_vehicle(folder)
    assert words in str(caught.value)


def test_a_mesh_is_in_the_unit_it_says(folder):
    expected = cab(folder).mesh
    edit(folder, "mesh =", 'mesh_unit = "in"\nmesh =')
    for found, part in zip(cab(folder).mesh, expected, strict=True):
        np.testing.assert_allclose(found.vertices, part.vertices * 0.0254, rtol=1e-14)
    edit(folder, 'mesh_unit = "in"', 'mesh_unit = "inch"')
    with pytest.raises(VehicleError, match=r"flexible_body\[0\].mesh_unit: .*unit of length 'inch'"):
        read_vehicle(folder)


def test_arrays_without_a_unit_of_mass_are_refused(folder):
    text = (folder / "vehicle.toml").read_text("utf-8")
    kept = [line for line in text.splitlines() if not line.startswith("mass = ")]
    text = "\n".join(kept).replace("[[rigid_body]]", "[[rigid_body]]\n", 1)
    start, end = text.index("[[added_mass]]"), text.index("[[mount_group]]")
    rigid = text.index("[[rigid_body]]")
    (folder / "vehicle.toml").write_text(text[:rigid] + text[end:], "utf-8")
    assert start < end
    with pytest.raises(
        VehicleError, match=r"flexible_body\[0\].modes: .*units.mass: missing, expected one"
    ):
        read_vehicle(folder)
