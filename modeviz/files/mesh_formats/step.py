"""STEP: solids of CAD programs as triangles, by OpenCASCADE (extra `step`).

cascadio is the whole of it in one wheel of 28 MB without dependencies, kept by who keeps trimesh, which
reads STEP through it too; gmsh takes more and the libraries of a screen, pythonocc has no wheels. It
runs in a process of its own: what is written in C++ may crash, take all memory or not end on a damaged
file, and prints what it likes.
"""

import re
import subprocess
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from modeviz.errors import VehicleError, cut
from modeviz.files.limits import most_allowed
from modeviz.files.mesh_formats.glb import read_glb
from modeviz.files.mesh_formats.limits import LARGEST_FILE
from modeviz.files.mesh_formats.parts import RawMesh
from modeviz.files.own_process import own_process
from modeviz.vehicle.bodies import Material

LONGEST_SECONDS = 60
"""Of the making of triangles."""

MOST_MEMORY = 4_000_000_000
"""Bytes, where the system can hold a process to them."""

CHORD, ANGLE = 0.01, 0.5
"""How far triangles may be from a surface, a part of its edges, and how many rad from each other."""

CONVERT = """
import cascadio
content = cascadio.load(
    sys.stdin.buffer.read(), "step", float(sys.argv[1]), float(sys.argv[2]), tol_relative=True
)
open(sys.argv[3], "wb").write(content)
"""

COLORS = re.compile(r"\x1b\[[0-9;]*m")
"""Of a terminal, in what is printed."""


def read_step(content: bytes, plain: Material) -> RawMesh:
    """The parts of a file, one for each of its solids; it says its unit.

    Raises:
        VehicleError: it is damaged, or takes too long; or cascadio is not installed.
    """
    if find_spec("cascadio") is None:
        raise VehicleError(
            "to read STEP files cascadio is needed: pip install 'modeviz[step]', or save it as .stl"
        )
    if not content.lstrip()[:12].upper().startswith(b"ISO-10303-21"):
        raise VehicleError("found no STEP file, which begins with 'ISO-10303-21'")
    with TemporaryDirectory(prefix="modeviz-") as folder:
        found = Path(folder) / "found.glb"
        said = _convert(content, found)
        glb = found.read_bytes() if found.is_file() else b""
    if b'"POSITION"' not in glb:
        raise VehicleError(f"found no solid or surface that can be drawn{said}")
    if len(glb) > most_allowed(LARGEST_FILE):
        raise VehicleError("makes too many triangles; save a coarser mesh of it as .stl or .glb")
    return RawMesh(read_glb(glb, plain), length=1.0)


def _convert(content: bytes, found: Path) -> str:
    """Writes the triangles of a file as GLB, in metres; returns words for what was printed last."""
    command = own_process(CONVERT, most_allowed(MOST_MEMORY), str(CHORD), str(ANGLE), str(found))
    seconds = most_allowed(LONGEST_SECONDS)
    try:
        done = subprocess.run(command, input=content, capture_output=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        raise VehicleError(
            f"takes longer than {seconds} s to be made triangles; save it as .stl or .glb"
        ) from None
    printed = (done.stdout + b"\n" + done.stderr).decode("utf-8", "replace")
    lines = [line.strip(" *") for line in COLORS.sub("", printed).splitlines()]
    told = next((line for line in lines if re.search(r"ERR|Error|Fail", line)), "")
    return f" ({cut(told, 200)})" if told else ""
