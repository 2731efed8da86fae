"""Vehicle folders with a component, a mesh and a road, damaged: one sentence and exit status 2 each."""

import io
import json
import shutil
import struct
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from damage import Damage, check_refusal, cut, exchanged, swapped, within_bounds
from network_files import network_unv

from modeviz.cli import main

PICKUP = Path(__file__).parents[3] / "shared/data/s3_pickup_mesh_and_road"
GLB, PLY, STL = (f"gazebo_pickup_metres.{kind}" for kind in ("glb", "ply", "stl"))

MOUNTS = """
[[mount_group]]
name = "M1"
rates = { vertical = 200.0, lateral = 100.0, fore_aft = 100.0 }
loss_factor = 0.1
[[mount_group.mount]]
name = "M1 left"
bodies = ["network", "ground"]
at = [0.0, 0.0, 0.0]
[[mount_group.mount]]
name = "M1 right"
bodies = ["network", "ground"]
at = [1.0, 0.0, 0.0]
[[rigid_body]]
name = "pickup"
mass = 1500.0
center_of_gravity = [1.0, 0.0, 0.5]
inertia = [500.0, 900.0, 1000.0]
mesh = "meshes/MESH"
"""


@pytest.fixture
def folder(tmp_path):
    """A vehicle of an imported component on two mounts, and a body with a mesh."""
    (tmp_path / "network.unv").write_text(network_unv())
    folder = tmp_path / "vehicle"
    options = ["--output", str(folder), "--units", "mm-t-s", "--attach", "11", "--attach", "12"]
    assert main(["import", str(tmp_path / "network.unv"), *options]) == 0
    return folder


def with_mesh(folder: Path, name: str) -> Path:
    """The file of the mesh of the folder's second body."""
    toml = folder / "vehicle.toml"
    toml.write_text(toml.read_text() + MOUNTS.replace("MESH", name))
    return Path(shutil.copy(PICKUP / name, folder / "meshes" / name))


def check_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> str:
    before = {path: path.stat().st_mtime for path in folder.rglob("*")}
    capsys.readouterr()
    with within_bounds():
        assert main(["modes", str(folder)]) == 2
    assert {path: path.stat().st_mtime for path in folder.rglob("*")} == before
    return check_refusal(capsys.readouterr().err)


def array(values: np.ndarray, pickled: bool = False) -> bytes:
    out = io.BytesIO()
    np.save(out, values, allow_pickle=pickled)
    return out.getvalue()


def header(shape: str) -> bytes:
    """An array's file that has no numbers, only what it says of them."""
    text = f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}"
    line = text.encode().ljust(117) + b"\n"
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(line)) + line


def member(name: str, content: bytes) -> Damage:
    """An archive in which an array is replaced."""

    def damage(archive: bytes) -> bytes:
        out = io.BytesIO()
        with zipfile.ZipFile(io.BytesIO(archive)) as old, zipfile.ZipFile(out, "w") as new:
            for one in old.namelist():
                new.writestr(one, content if one == name else old.read(one))
        return out.getvalue()

    return damage


def without(name: str) -> Damage:
    def damage(archive: bytes) -> bytes:
        out = io.BytesIO()
        with zipfile.ZipFile(io.BytesIO(archive)) as old, zipfile.ZipFile(out, "w") as new:
            for one in old.namelist():
                if one != name:
                    new.writestr(one, old.read(one))
        return out.getvalue()

    return damage


def bomb(_: bytes) -> bytes:
    """An archive of some megabytes whose shapes are over a gigabyte of zeros."""
    out = io.BytesIO()
    with (
        zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as new,
        new.open("shapes.npy", "w", force_zip64=True) as inside,
    ):
        inside.write(header("(1041666, 6, 24)"))
        for _ in range(120):
            inside.write(bytes(10_000_000))
    return out.getvalue()


def turned(name: str, change: Callable[[np.ndarray], np.ndarray]) -> Damage:
    """An archive in which an array is changed."""

    def damage(archive: bytes) -> bytes:
        with np.load(io.BytesIO(archive)) as arrays:
            return member(f"{name}.npy", array(change(arrays[name])))(archive)

    return damage


def not_finite(values: np.ndarray) -> np.ndarray:
    values = values.copy()
    values.flat[0] = np.nan
    return values


ARCHIVES: dict[str, tuple[Damage, str]] = {
    "empty": (lambda _: b"", "network.npz"),
    "cut in half": (cut(0.5), "network.npz"),
    "without its end": (cut(0.99), "network.npz"),
    "line ends of DOS": (lambda content: content.replace(b"\n", b"\r\n"), "network.npz"),
    "swapped": (swapped, "network.npz"),
    "text": (lambda _: network_unv().encode(), "network.npz"),
    "pickled": (member("shapes.npy", array(np.array([{"a": print}]), pickled=True)), "shapes"),
    "a pickle for the archive": (lambda _: b"\x80\x04N.", "network.npz"),
    "a bomb": (bomb, "shapes"),
    "a huge shape": (member("shapes.npy", header("(10**12, 6, 9)")), "shapes"),
    "a huge count": (member("shapes.npy", header("(999999999, 6, 24)")), "network.npz"),
    "no shapes": (without("shapes.npy"), "shapes"),
    "no frequencies": (without("omega_n_squared.npy"), "omega_n_squared"),
    "shapes not finite": (turned("shapes", not_finite), "shapes"),
    "frequencies not finite": (turned("omega_n_squared", not_finite), "omega_n_squared"),
    "shapes of too few nodes": (turned("shapes", lambda shapes: shapes[1:]), "shapes"),
    "shapes of text": (turned("shapes", lambda shapes: shapes.astype(str)), "shapes"),
    "complex shapes": (turned("shapes", lambda shapes: shapes * 1j), "shapes"),
    "a mode too few": (turned("omega_n_squared", lambda values: values[:-1]), "network"),
}  # fmt: skip


@pytest.mark.parametrize("name", ARCHIVES)
def test_damaged_modes_of_a_body_end_in_one_sentence(folder, capsys, name):
    damage, words = ARCHIVES[name]
    path = folder / "bodies/network.npz"
    path.write_bytes(damage(path.read_bytes()))
    assert words in check_refused(folder, capsys)


TABLES: dict[str, tuple[str, str]] = {
    "a mount where no node is": ("at = [1.0, 0.0, 0.0]", "at = [0.5, 0.5, 9.0]"),
    "a mount of no body": ('"network", "ground"', '"net work", "ground"'),
    "modes outside": ('"bodies/network.npz"', '"../network.npz"'),
    "modes at the root": ('"bodies/network.npz"', '"/etc/passwd"'),
    "modes behind a disk's letter": ('"bodies/network.npz"', '"C:network.npz"'),
    "a mesh outside": ('"meshes/network.glb"', '"meshes/../../network.unv"'),
    "a mesh that is a folder": ('"meshes/network.glb"', '"meshes"'),
    "a mesh that is no mesh": ('"meshes/network.glb"', '"bodies/network.npz"'),
    "not a number": ("loss_factor = 0.1", "loss_factor = nan"),
    "an infinite rate": ("vertical = 200.0", "vertical = inf"),
    "a rate of text": ("vertical = 200.0", "vertical = '200'"),
    "a name twice": ('name = "M1 right"', 'name = "M1 left"'),
    "a key that is none": ("loss_factor = 0.1", "lossfactor = 0.1"),
    "no end of a string": ('name = "M1"', 'name = "M1'),
    "deep arrays": ("at = [1.0, 0.0, 0.0]", "at = " + "[" * 5000 + "]" * 5000),
    "a place of two numbers": ("at = [1.0, 0.0, 0.0]", "at = [1.0, 0.0]"),
    "a mass below zero": ("mass = 1500.0", "mass = -1500.0"),
    "an inertia of no body": ("inertia = [500.0, 900.0, 1000.0]", "inertia = [1.0, 1.0, 1000.0]"),
}


@pytest.mark.shared
@pytest.mark.parametrize("name", TABLES)
def test_a_wrong_table_ends_in_one_sentence(folder, capsys, name):
    with_mesh(folder, GLB)
    old, new = TABLES[name]
    toml = folder / "vehicle.toml"
    before, found, after = toml.read_text().rpartition(old)  # comments have it too, before it
    assert found
    toml.write_text(before + new + after)
    check_refused(folder, capsys)


@pytest.mark.shared
@pytest.mark.parametrize("target", ["../../network.unv", "/etc/passwd"])
def test_links_that_leave_the_folder_end_in_one_sentence(folder, capsys, target):
    path = with_mesh(folder, GLB)
    path.unlink()
    path.symlink_to(target)
    check_refused(folder, capsys)


def glb(change: Callable[[dict], None]) -> Damage:
    """A GLB file whose JSON is changed."""

    def damage(content: bytes) -> bytes:
        length = struct.unpack_from("<I", content, 12)[0]
        document = json.loads(content[20 : 20 + length])
        change(document)
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        rest = content[20 + length :]
        head = struct.pack("<4sIIII", b"glTF", 2, 20 + len(text) + len(rest), len(text), 0x4E4F534A)
        return head + text + rest

    return damage


def outside(uri: str) -> Damage:
    return glb(lambda document: document["buffers"][0].update(uri=uri))


def accessor(**values: object) -> Damage:
    return glb(lambda document: [one.update(values) for one in document["accessors"]])


def view(**values: object) -> Damage:
    return glb(lambda document: [one.update(values) for one in document["bufferViews"]])


MESHES: list[tuple[str, str, Damage]] = [
    ("a buffer outside", GLB, outside("../../network.unv")),
    ("a buffer at the root", GLB, outside("/etc/passwd")),
    ("a buffer on the net", GLB, outside("http://127.0.0.1:9/a.bin")),
    ("a buffer in a scheme", GLB, outside("file:///etc/passwd")),
    ("a huge count", GLB, accessor(count=10**12)),
    ("a count below zero", GLB, accessor(count=-1)),
    ("an accessor beyond", GLB, accessor(byteOffset=10**9)),
    ("a view beyond", GLB, view(byteOffset=10**9)),
    ("a view of no buffer", GLB, view(buffer=7)),
    ("a node that is its own child", GLB, glb(lambda d: [n.update(children=[0]) for n in d["nodes"]])),
    ("no version", GLB, lambda content: content[:4] + bytes(4) + content[8:]),
    ("a chunk beyond", GLB, lambda content: content[:12] + b"\xff\xff\xff\x7f" + content[16:]),
    ("half", GLB, cut(0.5)),
    ("its first bytes", GLB, cut(0.0005)),
    ("text for JSON", GLB, exchanged(b'{"', b"hello")),
    ("a PLY file", GLB, lambda _: (PICKUP / PLY).read_bytes()),
    ("half", PLY, cut(0.5)),
    ("its header", PLY, cut(0.005)),
    ("a huge count", PLY, exchanged(b"element vertex ", b"element vertex 9999999999")),
    ("a count below zero", PLY, exchanged(b"element face ", b"element face -")),
    ("of no format", PLY, exchanged(b"format binary", b"format ternary")),
    ("half", STL, cut(0.5)),
    ("a huge count", STL, lambda content: content[:80] + b"\xff\xff\xff\xff" + content[84:]),
    ("not numbers", STL, lambda content: content[:96] + b"\0\0\xc0\x7f" * 3 + content[108:]),
    ("a GLB file", STL, lambda _: (PICKUP / GLB).read_bytes()),
]  # fmt: skip


@pytest.mark.shared
@pytest.mark.parametrize(
    ("name", "damage"), [m[1:] for m in MESHES], ids=[f"{m[1]}: {m[0]}" for m in MESHES]
)
def test_a_damaged_mesh_ends_in_one_sentence(folder, capsys, name, damage):
    path = with_mesh(folder, name)
    path.write_bytes(damage(path.read_bytes()))
    assert name in check_refused(folder, capsys)
