"""Real files of other programs, cut and corrupted: each ends in one sentence and exit status 2."""

import random
import re
import shutil
from pathlib import Path

import pytest
from damage import Damage, at, check_refusal, cut, exchanged, swapped, within_bounds

from modeviz.cli import main

pytestmark = pytest.mark.shared

SHARED = Path(__file__).parents[3] / "shared/data"
NASTRAN = SHARED / "s1_msc_modes_bdf_op2_f06"
UNIVERSAL = SHARED / "s2_uff_test_models"
OP2 = "mode_solid_shell_bar.op2"
BDF = "mode_solid_shell_bar.bdf"
QUADS = "mesh_Oros-modal_uff15_uff2412.uff"
LINES = "testlab_geometry_15_82_18.uff"
SHAPES = "uff55_translation.uff"


def half_swapped(content: bytes) -> bytes:
    half = len(content) // 8 * 4
    return content[:half] + swapped(content[half:])


def shape_nan(content: bytes) -> bytes:
    """NaN for the first motion of the first mode."""
    first = (13).to_bytes(4, "little") + (1).to_bytes(4, "little")  # grid 1, on the printer too
    place = content.index(first, content.index(b"OUGV1"))
    return at(place + 8, b"\0\0\xc0\x7f")(content)


def repeated_grid(content: bytes) -> bytes:
    """Grid 14 called 13, which is elsewhere."""
    grids = content.index((4501).to_bytes(4, "little")) + 12
    return at(content.index((14).to_bytes(4, "little") + bytes(4), grids), b"\x0d")(content)


def node_line(content: bytes, label: int, new: str) -> bytes:
    """The line of a node in data set 15 exchanged."""
    return re.sub(rb"(?m)^ *%d  .*$" % label, new.encode(), content, count=1)


DAMAGES: list[tuple[str, str, Damage]] = [
    *((f"cut at {part}", OP2, cut(part)) for part in (0.0, 0.0001, 0.01, 0.1, 0.5, 0.9, 0.99995)),
    ("line ends of DOS", OP2, exchanged(b"\n", b"\r\n", -1)),
    ("seven bits", OP2, lambda content: bytes(byte & 127 for byte in content)),
    ("words half swapped", OP2, half_swapped),
    ("without its beginning", OP2, lambda content: content[100:]),
    ("zeros at its end", OP2, lambda content: content[:20000] + bytes(len(content) - 20000)),
    ("a huge key", OP2, at(140, b"\xff\xff\xff\x7f")),
    ("a negative count", OP2, at(0, b"\xff\xff\xff\xff")),
    ("a NaN shape", OP2, shape_nan),
    ("a grid twice", OP2, repeated_grid),
    ("text", OP2, lambda _: (NASTRAN / BDF).read_bytes()),
    ("a universal file", OP2, lambda _: (UNIVERSAL / QUADS).read_bytes()),
    ("noise", OP2, lambda content: random.Random(1).randbytes(len(content))),
    ("an OP2 file", BDF, lambda _: (NASTRAN / OP2).read_bytes()),
    ("no include", BDF, exchanged("geom.inc", "nowhere.inc")),
    ("an include of itself", BDF, exchanged("geom.inc", BDF)),
    ("an endless include", BDF, exchanged("geom.inc", "/dev/zero")),
    ("a quote that does not end", BDF, exchanged("geom.inc'", "geom.inc")),
    ("letters for a coordinate", BDF, exchanged("13             .5", "13             x5")),
    ("letters for a number", BDF, exchanged("GRID     13 ", "GRID     1E3")),
    ("a grid twice", BDF, exchanged("GRID     5 ", "GRID     13")),
    ("no such system", BDF, exchanged("GRID     13      ", "GRID     13     9")),
    ("cut before its grids", BDF, cut(0.3)),
    *((f"cut at {part}", QUADS, cut(part)) for part in (0.0, 0.2, 0.5, 0.99)),
    ("UTF-16", QUADS, lambda content: content.decode().encode("utf-16")),
    ("a NaN place", QUADS, lambda c: node_line(c, 7, f"{7:10d}{0:10d}{0:10d}{1:10d} NaN 0 0")),
    ("letters", QUADS, exchanged("-5.16190E+01", "-5.1619QE+01")),
    ("a node twice", QUADS, lambda c: node_line(c, 7, f"{6:10d}{0:10d}{0:10d}{1:10d} 1.0 2.0 3.0")),
    ("a node gone", QUADS, lambda c: re.sub(rb"(?m)^ *25  .*\n", b"", c, count=1)),
    ("half a node", QUADS, exchanged(" -5.16190E+01  5.16190E+01", " -5.16190E+01")),
    ("a huge count", QUADS, exchanged("         1         4\n", "         1999999999\n")),
    ("axes on a line", QUADS, exchanged("0.00000E+00  1.00000E+00\n", "0.00000E+00  0.00000E+00\n")),
    ("a line lost", LINES, exchanged("         1         9         8\n", "")),
    ("too many nodes", LINES, exchanged("         1         9", "         1        99")),
    ("no units", LINES, exchanged("1.00000000000000000D+00", "0.00000000000000000D+00")),
    ("a number glued to another", LINES, exchanged("   164", "  1x64")),
    ("an OP2 file", LINES, lambda _: (NASTRAN / OP2).read_bytes()),
    *((f"cut at {part}", SHAPES, cut(part)) for part in (0.1, 0.6, 0.95)),
    ("a NaN shape", SHAPES, exchanged(" -1.46518e+00", "          NaN")),
    ("an infinite frequency", SHAPES, exchanged("  1.00000e+01", "     Infinity")),
    ("a negative frequency", SHAPES, exchanged("  1.00000e+01", " -1.00000e+01")),
    ("no header", SHAPES, exchanged("         1         2         2         8", "")),
    ("a huge count of values", SHAPES, exchanged("2         3\n", "2 999999999\n")),
    ("a huge count of parameters", SHAPES, exchanged("         2         4", " 999999999 999999999")),
    ("a node twice", SHAPES, exchanged("\n         2\n", "\n         1\n")),
]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "damage"), [d[1:] for d in DAMAGES], ids=[f"{d[1]}: {d[0]}" for d in DAMAGES]
)
def test_a_damaged_file_ends_in_one_sentence_and_nothing_is_written(name, damage, tmp_path, capsys):
    source = (NASTRAN if name in (OP2, BDF) else UNIVERSAL) / name
    path = tmp_path / name
    shutil.copy(NASTRAN / "geom.inc", tmp_path)
    path.write_bytes(damage(source.read_bytes()))
    folder = tmp_path / "vehicle"
    with within_bounds():
        assert main(["import", str(path)]) == 2
        assert check_refusal(capsys.readouterr().err).startswith(f"modeviz: {path}")
        assert main(["import", str(path), "--output", str(folder), "--units", "mm-t-s"]) == 2
    assert not folder.exists()
