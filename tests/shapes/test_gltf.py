import io
import json
import struct

import numpy as np
import pytest
import trimesh

from modeviz.shapes.gltf import glb
from modeviz.shapes.surface import surface
from modeviz.vehicle.bodies import Material, MeshPart
from modeviz.vehicle.srgb import srgb_to_linear

VERTICES = np.array([[0.0, 0, 0], [1.5, 0, 0], [1.5, 1, 0], [0, 1, 0.25]])
PANEL = MeshPart("panel", VERTICES, np.array([[0, 1, 2], [0, 2, 3]]), Material((202, 134, 98)))
GLASS = MeshPart(
    "glass", VERTICES + np.eye(3)[2], np.array([[0, 1, 2]]), Material((24, 32, 40), 0.86, 0.12, 0.3)
)


@pytest.fixture
def document():
    blob = glb(surface((PANEL, GLASS)), edge_color=(30, 36, 44))
    length = struct.unpack_from("<I", blob, 12)[0]
    return json.loads(blob[20 : 20 + length])


def test_another_reader_finds_the_same_triangles():
    scene = trimesh.load_scene(
        io.BytesIO(glb(surface((PANEL, GLASS)))), file_type="glb", merge_primitives=False, process=False
    )
    read = sorted((mesh.triangles.tolist() for mesh in scene.geometry.values()), key=len, reverse=True)
    assert read == [part.vertices[part.faces].tolist() for part in (PANEL, GLASS)]


def test_container_lengths_and_alignment_are_as_the_format_says():
    blob = glb(surface((PANEL, GLASS)), edge_color=(30, 36, 44))
    magic, version, length, json_length, json_kind = struct.unpack_from("<4sII I4s", blob)
    assert (magic, version, length, json_kind) == (b"glTF", 2, len(blob), b"JSON")
    binary_length, binary_kind = struct.unpack_from("<I4s", blob, 20 + json_length)
    assert binary_kind == b"BIN\0"
    assert 28 + json_length + binary_length == len(blob)
    assert json_length % 4 == binary_length % 4 == 0


def test_primitives_share_one_vertex_array(document):
    primitives = document["meshes"][0]["primitives"]
    assert [p["attributes"] for p in primitives] == [{"POSITION": 0}] * 3
    assert [p["mode"] for p in primitives] == [4, 4, 1]
    assert document["accessors"][0]["count"] == 8
    assert document["accessors"][3]["count"] == 2 * 5 - 2  # the panel's four borders, its fold is flat


def test_edges_are_left_out_without_a_color():
    blob = glb(surface((PANEL,)))
    length = struct.unpack_from("<I", blob, 12)[0]
    assert [p["mode"] for p in json.loads(blob[20 : 20 + length])["meshes"][0]["primitives"]] == [4]


def test_material_is_written_in_linear_light(document):
    panel, glass, edge = document["materials"]
    color = panel["pbrMetallicRoughness"]["baseColorFactor"]
    assert color == pytest.approx([*srgb_to_linear(np.array([202, 134, 98]) / 255), 1.0])
    assert glass["pbrMetallicRoughness"]["baseColorFactor"][3] == 0.86
    assert glass["pbrMetallicRoughness"]["roughnessFactor"] == 0.12
    assert glass["pbrMetallicRoughness"]["metallicFactor"] == 0.3
    assert [m["alphaMode"] for m in (panel, glass, edge)] == ["OPAQUE", "BLEND", "OPAQUE"]


def test_skin_is_marked(document):
    assert [m.get("extras") for m in document["materials"]] == [{"skin": True}, {"skin": True}, None]


def test_same_surface_gives_the_same_bytes():
    assert glb(surface((PANEL, GLASS)), (1, 2, 3)) == glb(surface((PANEL, GLASS)), (1, 2, 3))
