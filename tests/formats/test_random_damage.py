"""Files that can be imported, damaged at random: whatever comes of it is a vehicle or one sentence."""

import random
import shutil
from pathlib import Path

import pytest
from hdf5_files import network_hdf5
from network_files import network_op2, network_unv
from op2_files import Op2
from universal_files import shape_55

from modeviz.cli import main
from modeviz.files import read_vehicle

DECK = """SOL 103
CEND
BEGIN BULK
CORD2C,5,,0.,0.,0.,0.,0.,1.,+C
+C,1.,0.,0.
GRID,1,,0.,0.,0.
=,*1,=,*(10.),==
=(6)
GRID*                 20               5              3.             45.
*                     7.               5
CHEXA,7,1,1,2,3,4,5,6,+H
+H      7       8
PLOTEL,9,1,2,,10,3,4
EIGRL,1,,,24
ENDDATA
"""
SOURCES = [
    ("a.h5", network_hdf5().content()),
    ("a.bdf", DECK.encode()),
    ("a.unv", network_unv().encode()),
    ("a.unv", network_unv(write=shape_55).encode()),
    ("a.op2", network_op2(Op2())),
    ("a.op2", network_op2(Op2(">", 8))),
]
WORDS = (b"\xff" * 4, b"\0" * 4, b"\0\0\xc0\x7f", b"\xff\xff\xff\x7f", b"\x7f\xff\xff\xff")
TEXTS = (b"        -1", b"         0", b"2147483647", b"       nan", b" 1.0E+99  ", b"\xe9\xff\n\r\t")


def damaged(content: bytes, chance: random.Random) -> bytes:
    """The content with a few bytes, lines or words changed, lost, repeated or put in."""
    for _ in range(chance.choice([1, 1, 2, 5, 20])):
        first = chance.random() < 0.3
        at = chance.randrange(min(len(content), 400) if first else len(content)) if content else 0
        more = chance.choice([1, 4, 8, 80, 1000])
        other = chance.randrange(len(content)) if content else 0
        content = chance.choice(
            [
                content[:at] + chance.randbytes(1) + content[at + 1 :],
                content[:at] + content[at + more :],
                content[:at] + chance.randbytes(4) + content[at:],
                content[:at] + content[other : other + more] + content[at:],
                content[:at] + chance.choice(WORDS) + content[at + 4 :],
                content[:at] + chance.choice(TEXTS) + content[at + 10 :],
                content[:at] if chance.random() < 0.2 else content,
                content.replace(b"\n", b"\r\n", chance.choice([1, -1])),
            ]
        )
    return content


def check_damaged(folder: Path, seed: int, capsys: pytest.CaptureFixture[str]) -> int:
    """Imports a damaged file; its exit status."""
    chance = random.Random(seed)
    name, content = chance.choice(SOURCES)
    path, output = folder / name, folder / "vehicle"
    path.write_bytes(damaged(content, chance))
    attach = ["--attach", "11", "--attach", "seat=0,0,400"]
    status = main(["import", str(path), "--output", str(output), "--units", "mm-t-s", *attach])
    said = capsys.readouterr().err.splitlines()
    if status == 0:
        read_vehicle(output)
        shutil.rmtree(output)
    else:
        assert status == 2
        assert said[-1].startswith("modeviz: ")
        assert all(line.startswith("modeviz: note: ") for line in said[:-1])
    path.unlink()
    assert list(folder.iterdir()) == []
    return status


def test_files_damaged_at_random_are_imported_or_refused(tmp_path, capsys):
    assert {check_damaged(tmp_path, seed, capsys) for seed in range(150)} == {0, 2}


@pytest.mark.slow
def test_many_files_damaged_at_random_are_imported_or_refused(tmp_path, capsys):
    for seed in range(1000, 9000):
        check_damaged(tmp_path, seed, capsys)
