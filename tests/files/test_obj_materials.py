"""OBJ files have the colours of the materials beside them, and open nothing anywhere else."""

import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.files.meshes import DEFAULT_COLOR, read_mesh

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
TWO = "{library}usemtl red paint\nf 1 2 3\nusemtl glass\nf 1 3 4\nusemtl red paint\nf 1 2 4\n"
MTL = """# written by someone
newmtl red paint
Ns 250.0
Kd 1.0 0.2 0
map_Kd textures/red.png
newmtl glass
Kd 0.5
d 0.25
Pr 0.1
"""


@pytest.fixture
def read(tmp_path):
    def reader(obj: str, **files: str):
        (tmp_path / "a.obj").write_text(SQUARE + obj)
        for name, text in files.items():
            (tmp_path / f"{name}.mtl").write_text(text)
        return read_mesh(tmp_path / "a.obj")

    return reader


LIBRARIES = ["m.mtl", "/cars/m.mtl", "..\\cars\\m.mtl", "../../m.mtl", "other.mtl m.mtl"]


@pytest.mark.parametrize("library", LIBRARIES)
def test_faces_of_a_material_are_a_part_in_its_colour(read, library):
    red, glass = read(TWO.format(library=f"mtllib {library}\n"), m=MTL)
    assert (red.name, red.material.color, red.material.opacity) == ("red paint", (255, 51, 0), 1)
    assert (glass.name, glass.material.color, glass.material.opacity) == ("glass", (128,) * 3, 0.25)
    assert glass.material.roughness == 0.1
    np.testing.assert_array_equal(
        red.vertices[red.faces], [[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 0, 0], [0, 1, 0]]]
    )
    assert len(glass.vertices) == 3


@pytest.mark.parametrize("library", ["", "mtllib nowhere.mtl\n", "mtllib ..\n", "mtllib \n"])
def test_without_the_file_parts_are_plain(read, library):
    mesh = read(TWO.format(library=library))
    assert [part.name for part in mesh] == ["red paint", "glass"]
    assert {part.material.color for part in mesh} == {DEFAULT_COLOR}


def test_polygons_are_of_their_material_too(read):
    (part,) = read("mtllib m.mtl\nusemtl glass\nf 1 2 3 4\n", m=MTL)
    assert len(part.faces) == 2
    assert part.material.opacity == 0.25


def test_a_link_beside_it_that_leads_out_of_the_folder_is_refused(tmp_path):
    (tmp_path / "secret.mtl").write_text(MTL)
    (tmp_path / "in").mkdir()
    (tmp_path / "in/m.mtl").symlink_to(tmp_path / "secret.mtl")
    (tmp_path / "in/a.obj").write_text(SQUARE + TWO.format(library="mtllib m.mtl\n"))
    with pytest.raises(VehicleError, match=r"found 'm.mtl', expected a file inside"):
        read_mesh(tmp_path / "in/a.obj")


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("Kd 1 x 0", "m.mtl: line 2: Kd: found '1 x 0', expected numbers from 0 to 1, 1 or 3 of them"),
        ("d", "m.mtl: line 2: d: found '', expected numbers from 0 to 1, 1 of them"),
        ("Tr nan", "m.mtl: line 2: Tr: found 'nan'"),
    ],
)
def test_a_wrong_line_is_told_with_its_file(read, line, words):
    with pytest.raises(VehicleError) as caught:
        read(TWO.format(library="mtllib m.mtl\n"), m=f"newmtl glass\n{line}\n")
    assert words in str(caught.value)
