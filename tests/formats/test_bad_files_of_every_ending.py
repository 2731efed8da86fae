"""Whatever is in a file of any ending that is taken, a refusal names it once."""

import random
import warnings

import pytest
from damage import check_refusal
from network_files import network_op2, network_unv
from op2_files import Op2

from modeviz.cli import main
from modeviz.files.meshes import READERS as MESHES
from modeviz.formats.ansys import FULL, RESULTS
from modeviz.formats.endings import TAKEN

CONTENTS = {
    "nothing": b"",
    "text": b"so it goes\nand on\n",
    "zeros": bytes(600),
    "noise": random.Random(1).randbytes(3000),
    "archive": b"PK\3\4" + random.Random(2).randbytes(300),
    "numbers": b"1,2,3\n4,5,6\n",
}

ANSYS = (RESULTS, FULL)
"""Their library takes seconds to be there."""


def refused(capsys, *arguments: object) -> str:
    capsys.readouterr()
    assert main(["import", *map(str, arguments)]) == 2
    return check_refusal(capsys.readouterr().err)


def some_of(endings):
    """Each ending without a file and with two contents, others with the next two; the rest are slow."""
    names = [*CONTENTS]
    for i, ending in enumerate(endings):
        quick = {None, names[2 * i % len(names)], names[(2 * i + 1) % len(names)]}
        for content in (None, "noise") if ending in ANSYS else (None, *names):
            is_slow = content not in quick and ending not in ANSYS
            yield pytest.param(ending, content, marks=[pytest.mark.slow] if is_slow else [])


@pytest.mark.parametrize(("ending", "content"), some_of(TAKEN))
def test_a_bad_file_is_named_once(tmp_path, capsys, ending, content):
    path = tmp_path / f"wrong{ending}"
    if content is not None:
        path.write_bytes(CONTENTS[content])
    assert refused(capsys, path).count(path.name) == 1


@pytest.mark.parametrize(("ending", "content"), some_of(MESHES))
def test_a_bad_mesh_is_named_once(tmp_path, capsys, ending, content):
    path, body = tmp_path / f"wrong{ending}", tmp_path / "body.unv"
    body.write_text(network_unv())
    if content is not None:
        path.write_bytes(CONTENTS[content])
    options = ["--units", "mm-t-s", "--output", tmp_path / "vehicle", "--mesh", path]
    assert refused(capsys, body, *options).count(path.name) == 1


@pytest.mark.parametrize("content", [None, *CONTENTS])
@pytest.mark.parametrize(
    ("option", "ending"),
    [("--residual", ".csv"), ("--antisymmetric", ".unv"), ("--antisymmetric", ".op2")],
)
def test_another_bad_file_is_named_once(tmp_path, capsys, option, ending, content):
    path, body = tmp_path / f"wrong{ending}", tmp_path / "body.unv"
    body.write_text(network_unv())
    if content is not None:
        path.write_bytes(CONTENTS[content])
    options = ["--units", "mm-t-s", "--output", tmp_path / "vehicle", option, path]
    assert refused(capsys, body, *options).count(path.name) == 1


@pytest.mark.parametrize("content", [None, *CONTENTS])
@pytest.mark.parametrize("ending", [".csv", ".npz", ".bdf", ".pch"])
def test_a_bad_file_of_several_is_named_once(tmp_path, capsys, ending, content):
    path, body = tmp_path / f"wrong{ending}", tmp_path / "K.npz"
    body.write_bytes(CONTENTS["noise"])
    if content is not None:
        path.write_bytes(CONTENTS[content])
    said = refused(capsys, path, body, "--output", tmp_path / "vehicle")
    assert max(said.count(path.name), said.count(body.name)) == 1


@pytest.mark.parametrize("before", [Op2().words(11, 0), Op2().words(10 * 11 + 2, 1)])
def test_numbers_that_signal_that_they_are_none_are_refused_without_a_warning(tmp_path, capsys, before):
    """Of the first grid, and of a motion: widening such a number is invalid to the processor."""
    content = network_op2(Op2())
    at = content.index(before) + len(before)
    path = tmp_path / "a.op2"
    path.write_bytes(content[:at] + b"\x01\x00\x80\x7f" + content[at + 4 :])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert "not finite" in refused(capsys, path)
