"""COLLADA files: what its specification says of scenes, units and axes is read, damage is said."""

import itertools
import random
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.files.mesh_formats.parts import RawMesh
from modeviz.files.meshes import DEFAULT_COLOR, READERS, read_mesh
from modeviz.vehicle.bodies import Material

POSITIONS = "0 0 0  1 0 0  1 1 0  0 1 0"
SQUARE = np.array([[[0.0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]])
TRIANGLES = '<triangles material="m" count="2">{inputs}<p>0 0 1 1 2 2 0 0 2 2 3 3</p></triangles>'
INPUTS = (
    '<input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#n" offset="1"/>'
)
NODE = '<node name="door"><instance_geometry url="#g">{bound}</instance_geometry></node>'
BOUND = (
    "<bind_material><technique_common>"
    '<instance_material symbol="m" target="#paint"/></technique_common></bind_material>'
)
EFFECT = (
    '<library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong>{}</phong>'
    "</technique></profile_COMMON></effect></library_effects>"
    '<library_materials><material id="paint"><instance_effect url="#e"/></material></library_materials>'
)


def dae(
    primitives: str = TRIANGLES,
    nodes: str = NODE,
    asset: str = '<unit meter="1"/><up_axis>Z_UP</up_axis>',
    more: str = "",
    bound: str = "",
    accessor: str = 'count="4" stride="3"',
    positions: str = POSITIONS,
) -> str:
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>{asset}</asset>{more}
<library_geometries><geometry id="g" name="square"><mesh>
<source id="s"><float_array id="a" count="12">{positions}</float_array>
<technique_common><accessor source="#a" {accessor}/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
{primitives.format(inputs=INPUTS)}</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene">{nodes.format(bound=bound)}</visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#scene"/></scene></COLLADA>"""


@pytest.fixture
def read(tmp_path):
    def reader(text: str | bytes, **how):
        path = tmp_path / "mesh.dae"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_mesh(path, **how)

    return reader


def corners(mesh) -> np.ndarray:
    return np.concatenate([part.vertices[part.faces] for part in mesh])


@pytest.mark.parametrize(
    "primitives",
    [
        TRIANGLES,
        '<polylist count="1">{inputs}<vcount>4</vcount><p>0 0 1 1 2 2 3 3</p></polylist>',
        '<polygons count="1">{inputs}<p>0 0 1 1 2 2 3 3</p></polygons>',
        '<trifans count="1">{inputs}<p>0 0 1 1 2 2 3 3</p></trifans>',
        '<lines count="1">{inputs}<p>0 0 1 1</p></lines>' + TRIANGLES,
    ],
)
def test_polygons_of_every_kind_are_triangles(read, primitives):
    (part,) = read(dae(primitives))
    np.testing.assert_array_equal(part.vertices[part.faces], SQUARE)
    assert part.name == "door"
    assert part.material.color == DEFAULT_COLOR


def test_a_strip_turns_every_second_triangle_round(read):
    strip = '<tristrips count="1">{inputs}<p>0 0 1 1 3 3 2 2</p></tristrips>'
    normals = np.cross(*np.diff(corners(read(dae(strip))), axis=1).transpose(1, 0, 2))
    assert (normals[:, 2] > 0).all()


@pytest.mark.parametrize(
    ("up", "raw_up", "raw_right"),
    [("X_UP", [1, 0, 0], [0, -1, 0]), ("Y_UP", [0, 1, 0], [1, 0, 0]), ("Z_UP", [0, 0, 1], [1, 0, 0])],
)
def test_what_is_up_and_right_in_the_file_is_up_and_right_in_the_mesh(read, up, raw_up, raw_right):
    """COLLADA 1.4.1, <up_axis>: the table of right, up and inward axes."""
    corner = " ".join(str(x) for p in ([0, 0, 0], raw_up, raw_right) for x in p)
    text = dae(
        '<triangles count="1">{inputs}<p>0 0 1 0 2 0</p></triangles>',
        asset=f"<up_axis>{up}</up_axis>",
        positions=corner,
        accessor='count="3" stride="3"',
    )
    (triangle,) = corners(read(text))
    np.testing.assert_allclose(triangle, [[0, 0, 0], [0, 0, 1], [1, 0, 0]], atol=1e-15)


def test_the_unit_is_the_files_unless_another_is_said(read):
    inches = dae(asset='<unit name="inch" meter="0.0254"/><up_axis>Z_UP</up_axis>')
    np.testing.assert_allclose(corners(read(inches)), 0.0254 * SQUARE)
    np.testing.assert_allclose(corners(read(inches, length=1e-3)), 1e-3 * SQUARE)


@pytest.mark.parametrize(
    "place",
    [
        "<rotate>inf 0 0 90</rotate>",
        "<rotate>0 0 1 inf</rotate>",
        "<scale>1e308 1 1</scale><scale>1e308 1 1</scale><scale>0 1 1</scale>",
        "<matrix>nan 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>",
    ],
)
def test_places_beyond_all_numbers_are_refused_without_a_warning(read, place):
    node = '<node>{}<node><scale>0 1 1</scale><instance_geometry url="#g"/></node></node>'
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(VehicleError, match=r"not finite|expected"):
            read(dae(nodes=node.format(place)))


def test_axes_that_are_said_count_instead_of_the_files(read):
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    np.testing.assert_allclose(
        corners(read(dae(asset="<up_axis>Y_UP</up_axis>"), turn=turn)), SQUARE @ turn.T
    )


def test_nodes_move_what_is_in_them_in_the_order_of_their_transformations(read):
    nodes = (
        "<node><translate>10 0 0</translate><rotate>0 0 1 90</rotate><scale>2 1 1</scale>"
        "<node><matrix>1 0 0 0  0 1 0 0  0 0 1 5  0 0 0 1</matrix>" + NODE + "</node></node>"
    )
    found = corners(read(dae(nodes=nodes)))
    x, y = SQUARE[..., 0], SQUARE[..., 1]
    np.testing.assert_allclose(found, np.stack([10 - y, 2 * x, 5 + 0 * x], axis=-1), atol=1e-12)


def test_nodes_of_a_library_and_skins_are_placed_as_often_as_they_are_used(read):
    more = (
        f'<library_nodes><node id="wheel">{NODE.format(bound="")}</node></library_nodes>'
        '<library_controllers><controller id="c"><skin source="#g"><bind_shape_matrix>'
        "1 0 0 7 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix></skin></controller></library_controllers>"
    )
    nodes = (
        '<node><instance_node url="#wheel"/></node>'
        '<node><translate>0 0 3</translate><instance_node url="#wheel"/></node>'
        '<node name="soft"><instance_controller url="#c"/></node>'
    )
    mesh = read(dae(nodes=nodes, more=more))
    assert [part.name for part in mesh] == ["door", "door 2", "soft"]
    np.testing.assert_allclose(corners(mesh)[2:4], SQUARE + np.array([0, 0, 3]))
    np.testing.assert_allclose(corners(mesh)[4:], SQUARE + np.array([7, 0, 0]))


@pytest.mark.parametrize(
    ("shader", "color", "opacity"),
    [
        ("<diffuse><color>1 0 0.2 1</color></diffuse>", (255, 0, 51), 1),
        ('<diffuse><texture texture="x" texcoord="y"/></diffuse>', DEFAULT_COLOR, 1),
        (
            "<diffuse><color>0 0 1 1</color></diffuse>"
            '<transparent opaque="A_ONE"><color>1 1 1 1</color></transparent>'
            "<transparency><float>0.25</float></transparency>",
            (0, 0, 255),
            0.25,
        ),
        (
            '<diffuse><color>0 0 1 1</color></diffuse><transparent opaque="RGB_ZERO">'
            "<color>0.5 0.5 0.5 1</color></transparent>",
            (0, 0, 255),
            0.5,
        ),
        (
            "<diffuse><color>0 0 1 1</color></diffuse><transparency><float>0</float></transparency>",
            (0, 0, 255),
            1,
        ),
    ],
)
def test_a_part_has_the_colour_of_its_effect(read, shader, color, opacity):
    (part,) = read(dae(bound=BOUND, more=EFFECT.format(shader)))
    assert part.material.color == color
    assert part.material.opacity == pytest.approx(opacity)


LAUGHS = '<!DOCTYPE x [<!ENTITY a "ha">' + "".join(
    f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in itertools.pairwise("abcdefghij")
)
DEEP = "<node>" * 30_000 + "</node>" * 30_000
TWICE = "".join(
    f'<node id="n{i}"><instance_node url="#n{i + 1}"/><instance_node url="#n{i + 1}"/></node>'
    for i in range(40)
)
WRONG = {
    "entities": (dae().replace("<COLLADA", LAUGHS + "]><COLLADA", 1), "document type or entities"),
    "an outside entity": (
        dae().replace("<COLLADA", '<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]><COLLADA', 1),
        "document type or entities",
    ),
    "cut": (dae()[:700], "is not whole XML"),
    "other XML": ("<html/>", "found the element <html>, expected <COLLADA>"),
    "no text": ("\0\1\2", "is not whole XML"),
    "another file": (dae(nodes=NODE.replace("#g", "../x.dae#g")), "expected something in the file"),
    "the network": (
        dae(nodes=NODE.replace("#g", "http://x/y.dae#g")),
        "expected something in the file",
    ),
    "nothing": (dae(nodes=NODE.replace("#g", "#h")), "url: '#h' is named and not there"),
    "no faces": (dae(""), "found no triangles"),
    "too few vertices": (dae(TRIANGLES.replace("3 3", "9 9")), "names vertex 9; there are 4"),
    "before the first": (dae(TRIANGLES.replace("3 3", "-1 0")), "names vertex -1; there are 4"),
    "half a corner": (dae(TRIANGLES.replace("3 3", "3")), "found 11 indices, expected 2 for each"),
    "a word": (dae(TRIANGLES.replace("3 3", "x y")), "<p>: found something that is not a number"),
    "huge": (dae(TRIANGLES.replace("3 3", "1e300 0")), "indices beyond any vertex"),
    "not a number": (dae(positions=POSITIONS.replace("1 1 0", "nan 1 0")), "not finite"),
    "no unit": (dae(asset='<unit meter="inch"/>'), "meter: found 'inch', expected how many metres"),
    "no axis": (dae(asset="<up_axis>UP</up_axis>"), "expected one of X_UP, Y_UP, Z_UP"),
    "a wrong count": (
        dae('<polylist count="1">{inputs}<vcount>5</vcount><p>0 0 1 1 2 2 3 3</p></polylist>'),
        "tells 5 corners, <p> has 4",
    ),
    "two numbers a vertex": (dae(accessor='count="4" stride="2"'), "three numbers for each"),
    "half a matrix": (
        dae(nodes=f"<node><matrix>1 0 0</matrix>{NODE}</node>"),
        "<matrix>: found 3 numbers, expected 16",
    ),
    "skewed": (dae(nodes=f"<node><skew>1</skew>{NODE}</node>"), "<skew> in <node>: is not read"),
    "nodes without end": (
        dae(nodes='<node id="n"><instance_node url="#n"/></node>'),
        "found 20,001 nodes, expected at most",
    ),
    "nodes in nodes": (dae(nodes=DEEP), "nodes, expected at most"),
    "twice forty times": (
        dae(nodes=f'<node><instance_node url="#n0"/></node>{TWICE}<node id="n40"/>'),
        "nodes, expected at most",
    ),
    "elements without end": (dae(more="<a/>" * 400_000), "elements, expected at most 300,000"),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_file_is_explained_in_seconds(read, case):
    text, words = WRONG[case]
    start = time.process_time()
    with pytest.raises(VehicleError) as caught:
        read(text)
    assert time.process_time() - start < 10
    assert words in str(caught.value)
    assert len(str(caught.value)) < 500


def test_whatever_is_damaged_is_a_mesh_or_one_sentence():
    chance, content = random.Random(5), dae(bound=BOUND, more=EFFECT.format("")).encode()
    for _ in range(400):
        broken = bytearray(content)
        for _ in range(chance.choice([1, 1, 3, 10])):
            at = chance.randrange(len(broken))
            broken[at : at + chance.choice([0, 1, 5])] = chance.choice(
                [b"9", b"<", b"-1 ", b"\xff", b"", b"#", b"1e99"]
            )
        try:
            found = READERS[".dae"](bytes(broken), Material((1, 2, 3)), lambda _: None)
        except VehicleError:
            continue
        assert isinstance(found, RawMesh)


@pytest.mark.shared
def test_a_pickup_in_inches_has_the_size_and_the_faces_that_its_source_tells():
    """97.36 x 223.02 x 73.45 in and 1084 faces; the same in metres as STL, converted by trimesh."""
    folder = Path(__file__).parents[3] / "shared/data/s3_pickup_mesh_and_road"
    mesh = read_mesh(folder / "gazebo_pickup.dae")
    size = np.ptp(corners(mesh).reshape(-1, 3), axis=0)
    np.testing.assert_allclose(size, 0.0254 * np.array([97.36, 223.02, 73.45]), atol=2e-4)
    assert sum(len(part.faces) for part in mesh) == 1084
    stl = read_mesh(folder / "gazebo_pickup_metres.stl")
    np.testing.assert_allclose(size, np.ptp(corners(stl).reshape(-1, 3), axis=0), atol=1e-5)
