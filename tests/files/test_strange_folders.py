"""Folders from strangers: too large, endless or beyond any number; each is refused in a sentence."""

import os
import resource
import time
import tracemalloc
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from folders import one_of_everything

from modeviz.analysis.preparation import prepare
from modeviz.cli import main
from modeviz.compute import threads
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.limits import check_size
from modeviz.files.modal import ARRAYS
from modeviz.files.records import loads
from modeviz.files.roads import read_road
from modeviz.files.workload import counted

FILES = ["vehicle.toml", "roads/road_1.csv", "bodies/cab.npz", "meshes/cab.glb"]

SECONDS, BYTES = 10, 2_000_000_000

HEAD = """name = "x"
[units]
length = "m"
mass = "kg"
inertia = "kg m²"
stiffness = "N/m"
speed = "m/s"
"""
BODY = """[[rigid_body]]
name = "b{}"
mass = {}
center_of_gravity = [0, 0, 0]
inertia = [1, 1, 1]
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_vehicle(one_of_everything(), tmp_path / "a")
    return tmp_path / "a"


@pytest.fixture
def complaint(capsys: pytest.CaptureFixture[str]):
    """What the command says of a folder, held to its time and memory."""

    def complaint(folder: Path) -> str:
        capsys.readouterr()
        start = time.process_time()
        with memory():
            assert main(["modes", str(folder)]) == 2
        assert time.process_time() - start < SECONDS
        said = capsys.readouterr().err
        assert said.startswith("modeviz: ")
        assert said.count("\n") == 1
        assert len(said) < 3000
        assert not said.rstrip().endswith("()")
        return said

    return complaint


@contextmanager
def memory() -> Iterator[None]:
    """Not more memory than now and `BYTES`."""
    used = int(Path("/proc/self/statm").read_text("ascii").split()[5]) * resource.getpagesize()
    soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (used + BYTES, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))


def written(folder: Path, text: str) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "vehicle.toml").write_text(text, "utf-8")
    return folder


def sparse(path: Path, size: int) -> None:
    with path.open("wb") as file:
        file.truncate(size)


@pytest.mark.parametrize(
    "name", ["vehicle.toml", "roads/road_1.csv", "bodies/cab.npz", "meshes/cab.glb"]
)
def test_a_file_of_three_gigabytes_is_not_read(complaint, folder, name):
    sparse(folder / name, 3_000_000_000)
    text = complaint(folder)
    assert f"{name}: found 3,000,000,000 bytes, expected at most" in text
    assert "; MODEVIZ_LIMIT=" in text
    assert ("would allow 2,000,000,000\n" in text) == (name == "vehicle.toml")  # 1500 times its limit


@pytest.mark.parametrize(
    "name", ["vehicle.toml", "roads/road_1.csv", "bodies/cab.npz", "meshes/cab.glb"]
)
def test_a_pipe_is_not_waited_for(complaint, folder, name):
    (folder / name).unlink()
    os.mkfifo(folder / name)
    assert str(folder) in complaint(folder)


@pytest.mark.parametrize(
    "name", ["vehicle.toml", "roads/road_1.csv", "bodies/cab.npz", "meshes/cab.glb"]
)
def test_a_link_to_itself_leads_nowhere(complaint, folder, name):
    (folder / name).unlink()
    (folder / name).symlink_to(folder / name)
    assert str(folder) in complaint(folder)


@pytest.mark.parametrize("name", ["roads/road_1.csv", "bodies/cab.npz", "meshes/cab.glb"])
def test_a_link_out_of_the_folder_is_not_followed(complaint, folder, tmp_path, name):
    (folder / name).rename(tmp_path / "elsewhere")
    (folder / name).symlink_to(tmp_path / "elsewhere")
    assert f"found '{name}', expected a file inside the vehicle folder" in complaint(folder)


def bomb(path: Path, name: str) -> None:
    """An archive of some kilobytes, one array of which is hundreds of megabytes of zeros."""
    with np.load(path) as archive:
        arrays = dict(archive)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for key in ARRAYS:
            content = BytesIO()
            np.lib.format.write_array(content, arrays[key], allow_pickle=False)
            with archive.open(f"{key}.npy", "w", force_zip64=True) as file:
                if key != name:
                    file.write(content.getvalue())
                    continue
                np.lib.format.write_array_header_1_0(
                    file, {"descr": "<f4", "fortran_order": False, "shape": (5, 6, 10_000_000)}
                )
                for _ in range(3):
                    file.write(bytes(100_000_000))


def test_an_archive_that_unpacks_to_gigabytes_is_not_unpacked(complaint, folder):
    bomb(folder / "bodies/cab.npz", "shapes")
    assert (folder / "bodies/cab.npz").stat().st_size < 3_000_000
    assert "bytes of modes, expected at most 256,000,000; MODEVIZ_LIMIT=2" in complaint(folder)


def test_an_array_that_claims_more_than_is_there_is_refused(complaint, folder):
    path = folder / "bodies/cab.npz"
    with np.load(path) as archive:
        arrays = dict(archive)
    with zipfile.ZipFile(path, "w") as archive:
        for key, array in arrays.items():
            with archive.open(f"{key}.npy", "w") as file:
                if key == "nodes":
                    header = {"descr": "<f8", "fortran_order": False, "shape": (10**12, 3)}
                    np.lib.format.write_array_header_1_0(file, header)
                else:
                    np.lib.format.write_array(file, array, allow_pickle=False)
    assert "bodies/cab.npz: " in complaint(folder)


def test_bodies_that_name_the_same_modes_count_each(folder, monkeypatch):
    with zipfile.ZipFile(folder / "bodies/cab.npz") as archive:
        size = sum(member.file_size for member in archive.infolist())
    monkeypatch.setattr("modeviz.files.source.LARGEST_ARRAYS", size + size // 2)
    text = (folder / "vehicle.toml").read_text("utf-8")
    body = text[text.index("[[flexible_body]]") : text.index("[[rigid_body]]")]
    read_vehicle(folder)
    written(folder, text.replace(body, body + body.replace('"cab"', '"other cab"'), 1))
    with pytest.raises(VehicleError, match=f"found {2 * size:,} bytes of modes, expected at most"):
        read_vehicle(folder)


POINT = '[[response_point]]\nname = "p{0}"\nbody = "b0"\nat = [0.0, 0.0, 0.0]\n'

GROUP = """[[mount_group]]
name = "A"
rates = { vertical = 1e5, lateral = 1e5, fore_aft = 1e5 }
loss_factor = 0.1
"""
MOUNT = '[[mount_group.mount]]\nname = "m{}"\nbodies = ["b0", "ground"]\nat = [0, 0, 0]\n'
SPRING = """[[spring]]
name = "s{}"
bodies = ["b0", "ground"]
at = [0, 0, 0]
stiffness = [1e5, 1e5, 1e5]
"""
FORCE = """[[force]]
name = "f{}"
body = "b0"
at = [0, 0, 0]
direction = "vertical"
amplitude = 1
"""
MOTION = '[[base_motion]]\nname = "m{}"\ndirection = "vertical"\ndisplacement = 1\n'

TEXTS = {
    "2 000 free bodies": (
        HEAD + "".join(BODY.format(i, 1) for i in range(2_000)),
        "found 2,000 bodies, expected at most 150; MODEVIZ_LIMIT=14 in the environment",
    ),
    "a thousand response points": (
        HEAD + BODY.format(0, 1) + "".join(POINT.format(i) for i in range(1_000)),
        "found 216,000,000 responses among 0 mount springs, 3,000 directions of points and 0 of loads "
        "at 400 frequencies, expected at most 50,000,000; MODEVIZ_LIMIT=5 in the environment would",
    ),
    "150 mounts": (
        HEAD + BODY.format(0, 1) + GROUP + "".join(MOUNT.format(i) for i in range(150)),
        "responses among 450 mount springs, 0 directions of points and 0 of loads at 400 frequencies, "
        "expected at most 50,000,000; MODEVIZ_LIMIT=3 in the environment would allow them",
    ),
    "200 springs and points": (
        HEAD + BODY.format(0, 1) + "".join(SPRING.format(i) + POINT.format(i) for i in range(200)),
        "operations to solve 600 directions at 400 frequencies, expected at most 300,000,000,000; MO",
    ),
    "1 900 forces": (
        HEAD
        + 'force = "N"\n'
        + BODY.format(0, 1)
        + POINT.format(0)
        + "".join(FORCE.format(i) for i in range(1900)),
        "responses among 0 mount springs, 3 directions of points and 1,900 of loads at 400 frequencies",
    ),
    "1 900 motions of the ground": (
        HEAD
        + BODY.format(0, 1)
        + "".join(SPRING.format(i) for i in range(12))
        + "".join(MOTION.format(i) for i in range(1900)),
        "responses to 1,900 harmonic loads at 400 frequencies, expected at most 50,000,000; MODEVIZ_L",
    ),
    "100 000 free bodies": (
        HEAD + "".join(BODY.format(i, 1) for i in range(100_000)),
        "bytes, expected",
    ),
    "small tables by the thousand": (
        HEAD + BODY.format(0, 1) + '[[response_point]]\nname="a"\nbody="b"\nat=[0,0,0]\n' * 20_000,
        "found 20,000 tables [[response_point]], expected at most 2,000",
    ),
    "a mass of 1e50": (
        HEAD + BODY.format(0, 1e50),
        "[0].mass: found 1e+50 kg, expected 1e-09 to",
    ),
    "a mass of 1e99": (
        HEAD + BODY.format(0, 1e99),
        "[0].mass: found 1e+99 kg, expected 1e-09 to",
    ),
    "a mass of 1e-300": (HEAD + BODY.format(0, 1e-300), "found 1e-300 kg, expected 1e-09 to 1e+09"),
    "a place beyond the sky": (
        HEAD + BODY.format(0, 1).replace("[0, 0, 0]", "[0, 0, 1e40]"),
        "rigid_body[0].center_of_gravity: found 1e+40 m, expected up to 1e+06",
    ),
    "a key of 20 000 dots": (
        HEAD + "a." * 20_000 + "a = 1\n",
        "line 8: found a key of more than 32",
    ),
    "a header of 20 000 dots": (
        "[" + "a." * 20_000 + "a]\n",
        "line 1: found a key of more than 32 parts",
    ),
    "an inline key of 20 000 dots": (
        "a = { b = 1, " + "a." * 20_000 + "a = 1 }\n",
        "line 1: found a key of more than 32 parts",
    ),
    "lists in lists": (HEAD + "x = " + "[" * 100_000, "not TOML: it is nested too deeply\n"),
    "tables in tables": (
        HEAD + "\n".join(f"[{'.'.join(['a'] * 30)}{i}]" for i in range(3000)),
        "a: unknown key 'a'",
    ),
    "a hexadecimal number of a million digits": (
        HEAD + BODY.format(0, "0x" + "f" * 1_000_000),
        "rigid_body[0].mass: found a number of 1,204,120 digits, expected a finite number",
    ),
    "a decimal number of a million digits": (
        HEAD + BODY.format(0, "9" * 1_000_000),
        "not TOML: it has a whole number of more than 4,300 digits\n",
    ),
    "one text of 30 MB": ("name = '" + "x" * 30_000_000 + "'\n", "found 30,000,010 bytes, expected"),
}


@pytest.mark.parametrize("case", TEXTS)
def test_a_file_that_cannot_be_a_vehicle_is_refused_in_a_sentence(complaint, tmp_path, case):
    text, words = TEXTS[case]
    assert words in complaint(written(tmp_path / "a", text))


def test_a_road_of_three_million_lines_is_refused(complaint, folder):
    path = folder / "roads/road_1.csv"
    header = path.read_text("utf-8").partition("\n")[0]
    rows = "".join(f"{i},1,1,0,0\n" for i in range(1, 3_000_001))
    path.write_text(f"{header}\n{rows}", "utf-8")
    assert "roads/road_1.csv: found 46,888,942 bytes, expected at most 20,000,000" in complaint(folder)
    path.write_text(header + "\n" + "1,1,1,0,0\n" * 100_001, "utf-8")
    assert "roads/road_1.csv: found 100,002 lines, expected at most 100,000" in complaint(folder)


def test_a_table_without_line_ends_is_refused_in_a_sentence(complaint, folder):
    path = folder / "roads/road_1.csv"
    header = path.read_text("utf-8").partition("\n")[0]
    path.write_text(f"{header}\n{'1' * 19_000_000}", "utf-8")
    assert "road_1.csv: line 2: found 19,000,000 letters, expected at most 10,000\n" in complaint(
        folder
    )


@pytest.mark.parametrize(("n_mounts", "n_points", "n_forces"), [(40, 1, 1), (1, 100, 1), (1, 20, 60)])
def test_a_preparation_takes_the_memory_that_was_estimated(
    monkeypatch, tmp_path, n_mounts, n_points, n_forces
):
    """On one thread, for how many receptances are at hand on several depends on who else computes."""
    text = HEAD + 'force = "N"\n' + BODY.format(0, 1) + GROUP
    tables = ((MOUNT, n_mounts), (POINT, n_points), (FORCE, n_forces))
    text += "".join(table.format(i) for table, n in tables for i in range(n))
    vehicle = read_vehicle(written(tmp_path / "a", text))
    estimated = 16 * counted(vehicle).receptances
    monkeypatch.setattr(threads, "N_THREADS", 1)
    tracemalloc.start()
    prepare(vehicle)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert estimated / 10 < peak < 1.5 * estimated


def road_tables(n_roads: int) -> str:
    table = '[[road]]\nname = "r{}"\nfile = "roads/road_1.csv"\nspeed = 20\n'
    return "".join(table.format(i) for i in range(n_roads))


def test_a_table_that_many_roads_name_is_read_once_and_counts_for_each(complaint, folder, monkeypatch):
    path = folder / "vehicle.toml"
    path.write_text(path.read_text("utf-8") + road_tables(200), "utf-8")
    table = folder / "roads/road_1.csv"
    header = table.read_text("utf-8").partition("\n")[0]
    rows = "".join(f"{i / 100},1e-6,1e-6,1e-6,0\n" for i in range(1, 2001))
    table.write_text(f"{header}\n{rows}", "utf-8")
    words = "found 402,012 lines in the spectra of 203 loads, expected at most 300,000"
    assert f"vehicle.toml: {words}" in complaint(folder)
    monkeypatch.setenv("MODEVIZ_LIMIT", "2")
    read = []

    def counted(path: Path, *others):
        read.append(path)
        return read_road(path, *others)

    monkeypatch.setattr(loads, "read_road", counted)
    roads = read_vehicle(folder).roads
    assert len(roads) == len({road.name for road in roads}) > 200
    assert read.count(table) == 1


def test_an_archive_of_very_many_names_is_refused_in_a_sentence(complaint, folder):
    with zipfile.ZipFile(folder / "bodies/cab.npz", "w") as archive:
        for i in range(20_000):
            archive.writestr(f"array {i}.npy", b"")
    assert "omega_n_squared: missing; there are array 0, array 1, " in complaint(folder)


def test_no_limit_is_proposed_that_would_be_refused():
    with pytest.raises(VehicleError, match="MODEVIZ_LIMIT=1000 in the environment would allow them"):
        check_size("bytes", 1_000_000, 1000)
    with pytest.raises(
        VehicleError, match="MODEVIZ_LIMIT=1000 in the environment would allow 1,000,000"
    ):
        check_size("bytes", 1_000_001, 1000)


def test_raised_limits_take_no_memory_that_files_do_not_fill(folder, monkeypatch):
    monkeypatch.setenv("MODEVIZ_LIMIT", "1000")
    with memory():
        assert read_vehicle(folder).bodies


def test_limits_are_raised_by_the_environment(tmp_path, monkeypatch):
    folder = written(tmp_path / "a", HEAD + "".join(BODY.format(i, 1) for i in range(300)))
    with pytest.raises(VehicleError, match="MODEVIZ_LIMIT=2 in the environment"):
        read_vehicle(folder)
    monkeypatch.setenv("MODEVIZ_LIMIT", "2")
    assert len(read_vehicle(folder).bodies) == 300
    monkeypatch.setenv("MODEVIZ_LIMIT", "many")
    with pytest.raises(VehicleError, match="MODEVIZ_LIMIT: found 'many', expected a number from 1 to"):
        read_vehicle(folder)
