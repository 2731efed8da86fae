"""`python -m benchmarks.imported`: a large component imported, seen for the first time, and tuned.

A vehicle is made of an OP2 file and some lines: the component on four tyres, with an engine on three
mounts. Chromium is wanted, as for pictures.
"""

import argparse
import os
import time
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.large_component import STEP, Box, write_op2
from benchmarks.measure import ONE_THREAD, in_own_process, peak_bytes
from benchmarks.websocket import Drag, drag
from modeviz.cli import main as modeviz
from modeviz.files import read_vehicle
from modeviz.study.conditions import road_conditions
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.pictures.headless import HeadlessPage

BOX = Box(nodes=(160, 80, 40), n_modes=60)
SMALL = Box(nodes=(8, 6, 4), n_modes=12)
N_MOVES = 60

NAME = "frame"


@dataclass(frozen=True)
class Taken:
    """What something takes."""

    seconds: float
    peak_gb: float
    """Of memory, of the process with the server or the command."""


def main() -> None:
    """Prints what each step takes, and of a slider how many times as long as the truck's."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.imported", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="a small one: shows that all works")
    options = parser.parse_args()
    os.environ.update(ONE_THREAD)
    box, n_moves = (SMALL, 5) if options.quick else (BOX, N_MOVES)
    with TemporaryDirectory() as folder:
        path, vehicle = Path(folder) / f"{NAME}.op2", Path(folder) / "vehicle"
        in_own_process(write_op2, path, box)
        megabytes = path.stat().st_size / 1e6
        print(f"{box.n_nodes:,} nodes, {box.n_modes} modes, an OP2 file of {megabytes:,.0f} MB")
        taken = in_own_process(imported, path, vehicle, box)
        print(f"import         {taken.seconds:6.1f} s {taken.peak_gb:6.1f} GB", flush=True)
        taken = in_own_process(seen, vehicle)
        print(f"first picture  {taken.seconds:6.1f} s {taken.peak_gb:6.1f} GB", flush=True)
        moved, truck = (in_own_process(drag, n_moves, place) for place in (vehicle, None))
        print(f"a slider event {moved.websocket_ms:6.1f} ms, {_times(moved, truck)}")


def _times(moved: Drag, truck: Drag) -> str:
    """Of the wait for the spectrum and of the server's work, which other load disturbs less."""
    wait, work = moved.websocket_ms / truck.websocket_ms, moved.server_ms / truck.server_ms
    return f"{wait:.2f} times the truck's ({work:.2f} times its processor time)"


def imported(path: Path, folder: Path, box: Box) -> Taken:
    """Imports a component by the command line, and gives it an engine and tyres."""
    begin = time.perf_counter()
    attach = [f"--attach={name}={','.join(map(str, place))}" for name, place in _held(box).items()]
    with redirect_stdout(StringIO()):
        arguments = ["import", str(path), "--output", str(folder), "--units", "mm-t-s", *attach]
        status = modeviz(arguments)
    seconds = time.perf_counter() - begin
    assert status == 0
    with (folder / "vehicle.toml").open("a", encoding="utf-8") as file:
        file.write("\n".join(_rest(box)))
    return Taken(seconds, peak_bytes() / 1e9)


def _held(box: Box) -> dict[str, np.ndarray]:
    """Places of attachments, mm: four for tyres, three for mounts."""
    x, y, z = STEP * (np.array(box.nodes) - 1)
    corners = [(0, 0), (x, 0), (x, y), (0, y)]
    tyres = {f"tyre {n}": np.array([*corner, 0]) for n, corner in enumerate(corners)}
    return tyres | {f"mount {n}": np.array([*corner, z]) for n, corner in enumerate(corners[:3])}


def _rest(box: Box) -> list[str]:
    """The lines that make a vehicle of it."""
    held = {name: np.round(place / 1000, 4).tolist() for name, place in _held(box).items()}
    mounts = [name for name in held if name.startswith("mount")]
    lines = ["", "[[rigid_body]]", "name = 'engine'", "mass = 50.0", "inertia = [2.0, 2.0, 2.0]"]
    lines.append(f"center_of_gravity = {np.mean([held[name] for name in mounts], axis=0).tolist()}")
    lines += ["[[response_point]]", "name = 'seat'", f"body = '{NAME}'", f"at = {held['mount 0']}"]
    for name in [name for name in held if name not in mounts]:
        lines += ["[[tyre]]", f"name = '{name}'", f"bodies = ['{NAME}', 'ground']"]
        lines += [f"at = {held[name]}", f"wheel_center = {held[name]}", "stiffness = [100, 100, 200]"]
    lines += ["[[mount_group]]", "name = 'M1'", "loss_factor = 0.1"]
    lines.append("rates = { vertical = 200.0, lateral = 100.0, fore_aft = 100.0 }")
    for name in mounts:
        lines += ["[[mount_group.mount]]", f"name = '{name}'"]
        lines += [f"bodies = ['{NAME}', 'engine']", f"at = {held[name]}"]
    return lines


def seen(folder: Path) -> Taken:
    """Opens a vehicle's page as `modeviz view` does, until a browser has drawn it."""
    begin = time.perf_counter()
    vehicle = read_vehicle(folder)
    server = open_server(port=0)
    app = App(vehicle, vehicle.rates, road_conditions(vehicle, None, vehicle.speed), server)
    try:
        app.start()
        with HeadlessPage(lambda: server):
            seconds = time.perf_counter() - begin
    finally:
        app.close()
    return Taken(seconds, peak_bytes() / 1e9)


if __name__ == "__main__":
    main()
