"""Meshes of others: what their formats say is read, and what is not read is said."""

import logging
import re
import struct
import warnings
from io import BytesIO
from pathlib import Path
from zlib import crc32

import numpy as np
import pytest
import trimesh
from glb_files import SQUARE, TWO_FACES, GlbFile, container

from modeviz.errors import VehicleError
from modeviz.files.mesh_formats.limits import VARIABLE
from modeviz.files.meshes import DEFAULT_COLOR, read_mesh
from modeviz.vehicle.bodies import Material, MeshPart
from modeviz.vehicle.srgb import linear_to_srgb

RED = {"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}


def paint(*rgba: float, **keys) -> dict:
    return {"pbrMetallicRoughness": {"baseColorFactor": rgba}, **keys}


@pytest.fixture
def read(tmp_path, capfd, caplog):
    """Reads a file of some content; whoever it is that reads, prints nothing."""

    def reader(content: bytes, suffix: str = ".glb"):
        path = tmp_path / f"mesh{suffix}"
        path.write_bytes(content)
        try:
            return read_mesh(path)
        finally:
            assert capfd.readouterr() == ("", "")
            assert not [r for r in caplog.records if r.levelno >= logging.WARNING]

    return reader


@pytest.fixture
def complaint(read):
    def complain(content: bytes, suffix: str = ".glb") -> str:
        with pytest.raises(VehicleError) as caught:
            read(content, suffix)
        text = str(caught.value)
        assert "\n" not in text
        assert len(text) < 500
        assert " ()" not in text
        return text

    return complain


def corners(mesh) -> np.ndarray:
    """All triangles of a mesh, (n_faces, 3, 3)."""
    return np.concatenate([part.vertices[part.faces] for part in mesh])


def test_materials_go_by_their_place_and_not_by_their_name(read):
    glb = GlbFile()
    glb.surface(glb.square(paint(1, 0, 0, 1, name="paint")), name="a")
    glb.surface(glb.square(paint(0, 0, 1, 1, name="paint")), name="b")
    glb.surface(glb.square(paint(0, 1, 0, 1)), name="c")
    glb.surface(glb.square(), name="d")
    colors = {part.name: part.material.color for part in read(glb.content())}
    assert colors == {"a": (255, 0, 0), "b": (0, 0, 255), "c": (0, 255, 0), "d": DEFAULT_COLOR}


@pytest.mark.parametrize(
    ("keys", "opacity"),
    [
        ({}, 1.0),
        ({"alphaMode": "OPAQUE"}, 1.0),
        ({"alphaMode": "BLEND"}, 0.3),
        ({"alphaMode": "MASK"}, 0.0),
        ({"alphaMode": "MASK", "alphaCutoff": 0.2}, 1.0),
    ],
)
def test_alpha_counts_as_its_mode_says(read, keys, opacity):
    glb = GlbFile()
    glb.surface(glb.square(paint(1, 0, 0, 0.3, **keys)))
    assert read(glb.content())[0].material.opacity == pytest.approx(opacity)


def test_colours_of_vertices_are_averaged_in_linear_light(read):
    glb = GlbFile()
    colors = glb.accessor(
        np.array([[255, 0, 0], [0, 0, 0], [255, 0, 0], [0, 0, 0]], "u1"), normalized=True
    )
    glb.surface(glb.square(COLOR_0=colors))
    level = round(255 * float(linear_to_srgb(0.5)))
    assert read(glb.content())[0].material.color == (level, 0, 0)


def test_only_vertices_that_are_drawn_colour_a_part(read):
    glb = GlbFile()
    colors = glb.accessor(np.array([[1, 0, 0], [1, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4"))
    primitive = glb.square(COLOR_0=colors)
    glb.surface(primitive | {"indices": glb.accessor(np.array([0, 1, 2], "u1"))})
    assert read(glb.content())[0].material.color == (255, 0, 0)


def test_factor_texture_and_vertices_multiply(read):
    """Half of the texture is black, half white; the factor halves the red, the vertices all blue."""
    glb = GlbFile()
    pixels = np.zeros((8, 8, 3), np.uint8)
    pixels[:, :4] = 255
    material = paint(0.5, 1, 1, 1)
    material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": glb.image(pixels)}
    colors = glb.accessor(np.tile(np.array([1, 1, 0], "<f4"), (4, 1)))
    glb.surface(glb.square(material, COLOR_0=colors))
    expected = np.rint(255 * linear_to_srgb([0.25, 0.5, 0.0])).tolist()
    assert read(glb.content())[0].material.color == tuple(expected)


def test_what_a_texture_leaves_clear_has_no_colour(read):
    glb = GlbFile()
    pixels = np.zeros((8, 8, 4), np.uint8)
    pixels[:2] = (0, 255, 0, 255)
    material = paint(1, 1, 1, 1, alphaMode="BLEND")
    material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": glb.image(pixels)}
    glb.surface(glb.square(material))
    found = read(glb.content())[0].material
    assert found.color == (0, 255, 0)
    assert found.opacity == pytest.approx(0.25)


def test_strips_and_fans_are_triangles(read):
    glb = GlbFile()
    zigzag = glb.accessor(SQUARE[[0, 1, 3, 2]])
    around = glb.accessor(SQUARE)
    glb.surface({"attributes": {"POSITION": zigzag}, "mode": 5})
    glb.surface({"attributes": {"POSITION": around}, "mode": 6})
    strip, fan = (part.vertices[part.faces] for part in read(glb.content()))
    for triangles in (strip, fan):
        a, b, c = np.moveaxis(triangles, 1, 0)
        np.testing.assert_allclose(np.cross(b - a, c - a), [[0, 0, 1], [0, 0, 1]])


def test_points_and_lines_are_left_out(read, complaint):
    glb = GlbFile()
    position = glb.accessor(SQUARE)
    for mode in (0, 1, 2, 3):
        glb.surface({"attributes": {"POSITION": position}, "mode": mode})
    assert complaint(glb.content()).endswith("found no triangles")
    glb.surface(glb.square())
    assert len(read(glb.content())) == 1


def test_quantised_places_are_scaled(read):
    """KHR_mesh_quantization: signed bytes count from -127 to 127 for -1 to 1; -128 is -1 too."""
    glb = GlbFile()
    glb.document["extensionsRequired"] = ["KHR_mesh_quantization"]
    rows = np.array([[-128, 0, 0, 0], [127, 0, 0, 0], [127, -127, 0, 0], [0, 0, 0, 0]], "i1")
    view = glb.view(rows.tobytes(), byteStride=4)
    kind = {"bufferView": view, "componentType": 5120, "count": 4, "type": "VEC3"}
    scaled = {"attributes": {"POSITION": glb.add("accessors", kind | {"normalized": True})}}
    plain = {"attributes": {"POSITION": glb.add("accessors", kind)}}
    faces = glb.accessor(TWO_FACES)
    glb.surface(scaled | {"indices": faces}, scale=[2, 2, 2])
    glb.surface(plain | {"indices": faces})
    first, second = read(glb.content())
    np.testing.assert_allclose(first.vertices, [[-2, 0, 0], [2, 0, 0], [2, -2, 0], [0, 0, 0]])
    np.testing.assert_allclose(second.vertices, rows[:, :3])


@pytest.mark.parametrize("suffix", [".glb", ".ply", ".stl"])
def test_signalling_nans_are_refused_without_a_warning(complaint, suffix):
    glb = GlbFile()
    glb.surface(glb.square())
    contents = {".glb": glb.content(), ".ply": binary_ply([[0, 1, 2, 3]]), ".stl": stl(*HALVES)}
    one, signalling = np.float32(1).tobytes(), b"\1\0\x80\x7f"
    place = contents[suffix].rindex(one)
    content = contents[suffix][:place] + signalling + contents[suffix][place + 4 :]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert "not finite" in complaint(content, suffix)


def test_sparse_rows_replace_those_of_the_view_or_zeros(read):
    glb = GlbFile()
    places = glb.view(np.array([1, 3], "u1").tobytes())
    given = glb.view(np.array([[5, 0, 0], [0, 7, 0]], "<f4").tobytes())
    sparse = {
        "count": 2,
        "indices": {"bufferView": places, "componentType": 5121},
        "values": {"bufferView": given},
    }
    over = glb.accessor(SQUARE, sparse=sparse)
    zeros = glb.add("accessors", {"componentType": 5126, "count": 4, "type": "VEC3", "sparse": sparse})
    faces = glb.accessor(TWO_FACES)
    for index in (over, zeros):
        glb.surface({"attributes": {"POSITION": index}, "indices": faces})
    first, second = read(glb.content())
    np.testing.assert_array_equal(first.vertices, [[0, 0, 0], [5, 0, 0], [1, 1, 0], [0, 7, 0]])
    np.testing.assert_array_equal(second.vertices, [[0, 0, 0], [5, 0, 0], [0, 0, 0], [0, 7, 0]])


def test_interleaved_rows_are_read_by_their_stride(read):
    glb = GlbFile()
    rows = np.hstack([SQUARE, np.full((4, 2), 9, "<f4")]).astype("<f4")
    view = glb.view(rows.tobytes(), byteStride=20)
    kind = {"bufferView": view, "componentType": 5126, "count": 4, "type": "VEC3"}
    index = glb.add("accessors", kind)
    glb.surface({"attributes": {"POSITION": index}, "indices": glb.accessor(TWO_FACES)})
    np.testing.assert_array_equal(read(glb.content())[0].vertices, SQUARE)


def test_nodes_put_meshes_in_their_places(read):
    """A quarter turn about z, twice as large, then moved; the child once more."""
    glb = GlbFile()
    half = np.sqrt(0.5)
    turned = {"rotation": [0, 0, half, half], "scale": [2, 2, 2], "translation": [10, 0, 0]}
    matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 3, 0, 1]  # moves by 3 along y
    outer = glb.surface(glb.square(), name="outer", **turned)
    inner = glb.add("nodes", {"mesh": 0, "name": "inner", "matrix": matrix})
    glb.document["nodes"][outer]["children"] = [inner]
    first, second = read(glb.content())
    np.testing.assert_allclose(
        first.vertices, [[10, 0, 0], [10, 2, 0], [8, 2, 0], [8, 0, 0]], atol=1e-12
    )
    np.testing.assert_allclose(second.vertices, first.vertices - [6, 0, 0], atol=1e-12)


def test_another_reader_finds_the_same_triangles(read):
    rng = np.random.default_rng(5)
    scene = trimesh.Scene()
    for i in range(5):
        turn = trimesh.transformations.random_rotation_matrix(rng.random(3))
        turn[:3, 3] = rng.normal(size=3)
        parent = f"node {i - 1}" if i else None
        box = trimesh.creation.box(rng.random(3) + 0.1)
        scene.add_geometry(box, node_name=f"node {i}", parent_node_name=parent, transform=turn)
    content = scene.export(file_type="glb")
    again = trimesh.load_scene(BytesIO(content), file_type="glb", process=False)
    expected = np.concatenate([g.triangles for g in again.dump()])
    found = corners(read(content))
    assert found.shape == expected.shape
    by_place = [
        np.sort(t.reshape(-1, 9).round(4).view([("", float)] * 9), axis=0) for t in (found, expected)
    ]
    np.testing.assert_array_equal(*by_place)


def test_vertices_that_no_face_names_are_left_out(read):
    glb = GlbFile()
    far = glb.accessor(np.vstack([SQUARE, [[1e4, 0, 0]]]).astype("<f4"))
    glb.surface({"attributes": {"POSITION": far}, "indices": glb.accessor(TWO_FACES)})
    np.testing.assert_array_equal(read(glb.content())[0].vertices, SQUARE)


def test_parts_of_one_name_are_told_apart(read):
    glb = GlbFile()
    for name in ("door", "door 2", "door", "", "door", ""):
        glb.surface(glb.square(), name=name)
    names = [part.name for part in read(glb.content())]
    assert names == ["door", "door 2", "door 3", "part", "door 4", "part 2"]


@pytest.mark.parametrize(
    "extension",
    ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing", "X_new"],
)
def test_a_required_extension_that_is_not_read_is_refused_by_name(complaint, extension):
    glb = GlbFile()
    glb.surface(glb.square())
    glb.document["extensionsRequired"] = ["KHR_materials_unlit", extension]
    assert f"requires the glTF extension {extension}, which is not read" in complaint(glb.content())


def changed(*path, value=None):
    """What changes one value of a document, or takes it away."""

    def change(document):
        *inner, last = path
        for key in inner:
            document = document[key]
        if value is None:
            del document[last]
        else:
            document[last] = value

    return change


NAN = float("nan")
IDENTITY = np.eye(4).ravel().tolist()
WRONG = {
    "no bytes": (changed("accessors", 0, "bufferView"), "accessors[0]: has no bytes"),
    "too many rows": (
        lambda d: d["accessors"][0].update(count=200_000_000),
        "found 200,000,000 rows in accessors[0], expected at most 3,000,000",
    ),
    "rows beyond the view": (
        changed("accessors", 0, "count", value=5),
        "accessors[0]: ends at byte 60",
    ),
    "view beyond the buffer": (
        changed("bufferViews", 0, "byteLength", value=10**6),
        "bufferViews[0]: ends at byte 1000000 of 60",
    ),
    "no such accessor": (
        changed("meshes", 0, "primitives", 0, "attributes", "POSITION", value=9),
        "accessors[9]: is named and not there; there are 2",
    ),
    "no such mesh": (changed("nodes", 0, "mesh", value=3), "meshes[3]: is named and not there"),
    "no such material": (
        changed("meshes", 0, "primitives", 0, "material", value=3),
        "materials[3]: is named and not there",
    ),
    "no such node": (changed("scenes", 0, "nodes", value=[4]), "nodes[4]: is named and not there"),
    "nodes in a circle": (
        changed("nodes", 0, "children", value=[0]),
        "nodes[0]: is reached twice, expected nodes that form trees",
    ),
    "not a number in a matrix": (
        changed("nodes", 0, "matrix", value=[NAN, *IDENTITY[1:]]),
        "nodes[0].matrix[0]: found nan, expected a finite number",
    ),
    "overflow": (
        changed("nodes", 0, "scale", value=[1e90] * 3),
        "found a vertex 1e+90 m from the origin",
    ),
    "face of a vertex that is not there": (
        changed("accessors", 0, "count", value=3),
        "a face names vertex 3; there are 3",
    ),
    "wrong type": (
        changed("accessors", 0, "type", value="VEC2"),
        "accessors[0]: found VEC2, expected VEC3",
    ),
    "wrong component": (
        changed("accessors", 0, "componentType", value=5124),
        "accessors[0].componentType: unknown value '5124'",
    ),
    "negative": (
        changed("bufferViews", 0, "byteOffset", value=-4),
        "bufferViews[0].byteOffset: found -4",
    ),
    "missing": (changed("accessors", 0, "count"), "accessors[0].count: missing"),
    "another file": (
        changed("buffers", value=[{"byteLength": 60, "uri": "../../secret.bin"}]),
        "buffers[0]: names the file '../../secret.bin', expected all within the .glb file",
    ),
    "buffer cut": (
        changed("buffers", value=[{"byteLength": 6000}]),
        "buffers[0]: found 60 of its 6000",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_document_is_explained(complaint, case):
    change, words = WRONG[case]
    glb = GlbFile()
    glb.surface(glb.square(), name="a")
    glb.document.setdefault("buffers", [{"byteLength": len(glb.binary)}])
    change(glb.document)
    assert words in complaint(glb.content())


def test_longer_circles_of_nodes_and_shared_children_are_refused(complaint):
    glb = GlbFile()
    first = glb.surface(glb.square())
    for _ in range(3):
        glb.add("nodes", {"children": [len(glb.document["nodes"]) + 1]})
    glb.document["nodes"][-1]["children"] = [1]
    glb.document["nodes"][first]["children"] = [1]
    assert "reached twice" in complaint(glb.content())


CONTAINERS = {
    b"": "found no bytes, expected a binary glTF, which begins with 'glTF'",
    b"version https://git-lfs.github.com/spec/v1\n": "found bytes that begin with 'vers', expected a",
    struct.pack("<4sII", b"glTF", 1, 20) + bytes(8): "found glTF 1, expected glTF 2",
    struct.pack("<4sII", b"glTF", 2, 900) + bytes(8): "is cut: found 20 of its 900 bytes",
    struct.pack("<4sII", b"glTF", 2, 12): "found no JSON chunk",
    struct.pack("<4sIII4s", b"glTF", 2, 20, 99, b"JSON"): "the chunk at byte 12 ends behind",
    container(b"{]  ", b""): "its JSON cannot be read (",
    container(b"[" * 100_000, b""): "its JSON cannot be read (it is nested too deeply)",
    container(b'{"x": ' + b"9" * 5000 + b"}", b""): "(it has a whole number of more than 4,300 digits)",
    container(b'{"x": "\xff"}', b""): "its JSON cannot be read (its bytes are not UTF-8 text)",
    container(b"[1] ", b""): "found [1], expected a table",
}


@pytest.mark.parametrize("content", CONTAINERS, ids=CONTAINERS.values())
def test_what_is_no_binary_gltf_is_explained(complaint, content):
    assert CONTAINERS[content] in complaint(content)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"not an image", "images[0]: found no PNG or JPEG"),
        (b"\x89PNG\r\n\x1a\n" + bytes(9), "images[0]: "),
    ],
)
def test_a_damaged_texture_is_explained(complaint, content, words):
    assert words in complaint(textured(content))


@pytest.mark.parametrize(
    ("side", "words"),
    [
        (11_000, "found 121,000,000 pixels of textures, expected at most 100,000,000"),
        (30_000, "too large"),
    ],
)
def test_a_texture_of_very_many_pixels_is_refused_before_it_is_decoded(complaint, side, words):
    header = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    png = b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", header) + png_chunk(b"IDAT", bytes(9))
    assert words in complaint(textured(png))


def textured(image: bytes) -> bytes:
    """A file with a square that has an image for its texture."""
    glb = GlbFile()
    source = glb.add("images", {"bufferView": glb.view(image)})
    material = paint(1, 1, 1, 1)
    texture = glb.add("textures", {"source": source})
    material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": texture}
    glb.surface(glb.square(material))
    return glb.content()


def png_chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", crc32(kind + content))


PLY = """ply
format {format} 1.0
comment TextureFile paint.png
element vertex {n_vertices}
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face {n_faces}
property list uchar int vertex_indices
end_header
"""
ROWS = "0 0 0 255 0 0\n1 0 0 0 0 0\n1 1 0 255 0 0\n0 1 0 0 0 0\n"


def ply(rows: str = ROWS, faces: str = "4 0 1 2 3\n", n_vertices: int = 4, n_faces: int = 1) -> bytes:
    head = PLY.format(format="ascii", n_vertices=n_vertices, n_faces=n_faces)
    return (head + rows + faces).encode()


def binary_ply(faces, order="<") -> bytes:
    name = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    content = PLY.format(format=name, n_vertices=4, n_faces=len(faces)).encode()
    for place, red in zip(SQUARE, (255, 0, 255, 0), strict=True):
        content += struct.pack(f"{order}fffBBB", *place.tolist(), red, 0, 0)
    for face in faces:
        content += struct.pack(f"{order}B{len(face)}i", len(face), *face)
    return content


@pytest.mark.parametrize(
    "content",
    [
        ply(),
        ply(faces="3 0 1 2\n3 0 2 3\n", n_faces=2),
        ply(faces="3 0 1 2\n4 0 2 3 3\n", n_faces=2),
        ply(faces="3 0 1 2 77 78\n3 0 2 3\n", n_faces=2),
        ply(rows=ROWS.replace("\n", "\r\n")),
        binary_ply([(0, 1, 2), (0, 2, 3)]),
        binary_ply([(0, 1, 2, 3)], ">"),
        binary_ply([(0, 1, 2), (0, 2, 3, 3)], ">"),
    ],
)
def test_ply_has_its_triangles_and_the_mean_of_its_colours(read, content):
    (part,) = read(content, ".ply")
    a, b, c = np.moveaxis(part.vertices[part.faces], 1, 0)
    assert np.cross(b - a, c - a).sum(axis=0).tolist() == [0, 0, 2]
    assert part.material.color == (round(255 * float(linear_to_srgb(0.5))), 0, 0)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (ply(n_faces=40), "of the element face found 1 whole items of the 40"),
        (
            ply(rows=ROWS[:-16], faces="", n_faces=0),
            "of the element vertex found 3 whole items of the 4",
        ),
        (binary_ply([(0, 1, 2)])[:-1], "is cut"),
        (
            binary_ply([(0, 1, 2), (0, 2, 3, 3)])[:-1],
            "of the element face found 1 whole items of the 2",
        ),
        (ply(faces="4 0 1 2 4\n"), "a face names vertex 4; there are 4"),
        (ply(faces="nan 0 1 2\n"), "is cut"),
        (ply(faces="4 0 1 two 3\n"), "found something that is not a number"),
        (ply(n_faces=10**12), "found 1,000,000,000,000 items of the element face, expected at most"),
        (ply().replace(b"float z", b"float y"), "element vertex: property 'y' is there twice"),
        (ply().replace(b"float z", b"flout z"), "found the header line 'property flout z'"),
        (ply().replace(b"ascii", b"utf"), "found the format 'utf', expected one of"),
        (ply().replace(b"ascii", b"x" * 999), "found the format '" + "x" * 52 + "…"),
        (ply().replace(b"float z", b"float w"), "found vertices without x, y and z"),
        (ply(faces="", n_faces=0), "found no triangles"),
        (b"ply", "found no header of a PLY"),
    ],
)
def test_wrong_ply_is_explained(complaint, content, words):
    assert words in complaint(content, ".ply")


def stl(*triangles) -> bytes:
    content = bytes(80) + struct.pack("<I", len(triangles))
    return content + b"".join(
        struct.pack("<12fH", 0, 0, 1, *np.ravel(t).tolist(), 0) for t in triangles
    )


def text_stl(*triangles) -> bytes:
    lines = ["solid A BRACKET"]
    for triangle in triangles:
        lines += ["facet normal 0 0 1", " outer loop"]
        lines += [f"  vertex {x} {y:e} {z}" for x, y, z in triangle]
        lines += [" endloop", "endfacet"]
    return "\n".join([*lines, "endsolid A BRACKET"]).encode()


HALVES = SQUARE[TWO_FACES].reshape(2, 3, 3)


@pytest.mark.parametrize("write", [stl, text_stl, lambda *t: text_stl(*t).upper()])
def test_stl_has_its_triangles_on_vertices_that_are_there_once(read, write):
    (part,) = read(write(*HALVES), ".stl")
    np.testing.assert_array_equal(part.vertices[part.faces], HALVES)
    assert len(part.vertices) == 4


def test_stl_with_numbers_that_are_none_is_refused_without_a_warning(complaint):
    signalling = struct.pack("<I", 0x7F800001)  # not a number, of which NumPy warns when it converts it
    content = bytes(80) + struct.pack("<I", 1) + bytes(12) + signalling + bytes(34)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert "not finite" in complaint(content, ".stl")


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (stl(*HALVES)[:-1], "is cut: found 1 of its 2 faces"),
        (stl(*HALVES)[:80] + struct.pack("<I", 2 * 10**8), "is cut: found 0 of its 200000000 faces"),
        (text_stl(*HALVES)[:-18], "is cut: found no 'endsolid' at its end"),
        (
            text_stl(*HALVES).replace(b"1.0 0.0", b"1.0 nan", 1),
            "coordinates of 6 vertices, expected three",
        ),
        (text_stl(), "found no triangles"),
        (stl(), "found no triangles"),
        (b"hello", "found neither a text that begins with 'solid' nor"),
        (
            text_stl(*1e300 * HALVES.astype(float)),
            "1e+300 m from the origin, expected at most 100000 m",
        ),
    ],
)
def test_wrong_stl_is_explained(complaint, content, words):
    assert words in complaint(content, ".stl")


OBJ = "mtllib /etc/paint.mtl\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 9 9 9\nv 0 1 0\nusemtl red\n"


@pytest.mark.parametrize(
    "faces",
    [
        "f 1 2 3 5",
        "f 1/1 2/2 3/1\nf 1//1 3//1 5//1",
        "f -5 -4 -3 -1",
        "f 1 2 3 \\\n5",
        "f 1 2 3\r\nf 1 3 5\r\n",
    ],
)
def test_obj_has_its_triangles_and_opens_no_other_file(read, faces):
    (part,) = read((OBJ + faces).encode(), ".obj")
    np.testing.assert_array_equal(part.vertices[part.faces], HALVES)
    assert len(part.vertices) == 4


def test_obj_counts_back_from_where_a_face_stands(read):
    (part,) = read(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -4 -2 -1\n", ".obj")
    np.testing.assert_array_equal(part.vertices[part.faces], HALVES)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (OBJ + "f 1 2 6", "a face names vertex 6; there are 5"),
        (OBJ + "f 1 2 0", "a face names vertex 0; there are 5"),
        (OBJ + "f 1 2 x", "found something that is not a number"),
        (OBJ.replace("v 1 1 0", "v 1 1") + "f 1 2 3", "found a vertex without three coordinates"),
        (OBJ, "found no triangles"),
        ("", "found no triangles"),
    ],
)
def test_wrong_obj_is_explained(complaint, text, words):
    assert words in complaint(text.encode(), ".obj")


def test_a_huge_file_is_refused_before_it_is_read(tmp_path):
    path = tmp_path / "huge.stl"
    with path.open("wb") as file:
        file.truncate(3_000_000_000)  # takes no room on the disk
    words = f"found 3,000,000,000 bytes, expected at most 256,000,000; {VARIABLE}=12 in the environment"
    with pytest.raises(VehicleError, match=re.escape(words)):
        read_mesh(path)


def test_the_limits_can_be_raised(tmp_path, monkeypatch):
    path = tmp_path / "a.ply"
    path.write_bytes(ply(n_faces=1_500_000))
    with pytest.raises(VehicleError, match=f"at most 1,000,000; {VARIABLE}=2 "):
        read_mesh(path)
    monkeypatch.setenv(VARIABLE, "2")
    with pytest.raises(VehicleError, match="is cut"):
        read_mesh(path)
    monkeypatch.setenv(VARIABLE, "much")
    with pytest.raises(
        VehicleError, match=f"{VARIABLE}: found 'much', expected a number from 1 to 1000"
    ):
        read_mesh(path)


def test_a_part_far_outside_is_refused_wherever_it_comes_from():
    with pytest.raises(VehicleError, match="found a vertex 2e\\+05 m from the origin"):
        MeshPart("a", 2e5 * np.eye(3), np.array([[0, 1, 2]]), Material((0, 0, 0)))


@pytest.mark.shared
@pytest.mark.parametrize("suffix", [".glb", ".stl", ".ply"])
def test_a_pickup_of_others_has_the_size_its_source_tells(suffix):
    """2.473 x 5.665 x 1.866 m and 1084 faces, whoever converted it."""
    folder = Path(__file__).parents[3] / "shared/data/s3_pickup_mesh_and_road"
    mesh = read_mesh(folder / f"gazebo_pickup_metres{suffix}")
    size = np.ptp(corners(mesh).reshape(-1, 3), axis=0)
    np.testing.assert_allclose(np.sort(size), [1.866, 2.473, 5.665], atol=1e-3)
    assert sum(len(part.faces) for part in mesh) == 1084
