"""Residual vectors that files have among their modes, and those that are given in numbers."""

import numpy as np
import pytest
from free_network import CORNERS, LABELS, free_network
from network_files import network_op2, network_unv
from op2_files import Op2

from modeviz.cli import main
from modeviz.files import read_vehicle
from modeviz.formats.nastran import read_nastran

GRIDS = "".join(
    f"GRID,{label},,{x:.1f},{y:.1f},{z:.1f}\n" for label, (x, y, z) in zip(LABELS, CORNERS, strict=True)
)


@pytest.fixture
def read(tmp_path):
    def read(op2, *cards):
        (tmp_path / "a.op2").write_bytes(op2)
        (tmp_path / "a.bdf").write_text("BEGIN BULK\n" + GRIDS + "\n".join(cards) + "\nENDDATA\n")
        files = [tmp_path / "a.op2"] + ([tmp_path / "a.bdf"] if cards else [])
        return read_nastran(files)

    return read


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("flags", [(1, 2), (2, 1)])
def test_modes_that_the_table_from_before_lacks_are_residual_vectors(read, order, flags):
    component = read(network_op2(Op2(order), residual_flags=flags))
    assert component.modes.n_residuals == 4
    np.testing.assert_allclose(component.modes.modal_mass, 1)


TOP = free_network().frequency_hz[20]


@pytest.mark.parametrize(
    ("card", "n_residuals"),
    [
        ("EIGRL,1,,,20", 4),
        ("EIGR,1,LAN,,,,20", 4),
        (f"EIGRL,1,-1.,{TOP:.4f}", 3),
        (f"EIGR,1,LAN,-1.,{TOP:.4f}", 3),
        ("EIGRL,1,,,24", 0),
        ("EIGRL,1,,1.+4", 0),
        ("EIGRL,1,,,20\nEIGRL,2,,,22", 0),
    ],
)
def test_modes_beyond_what_the_input_asks_for_are_residual_vectors(read, card, n_residuals):
    assert read(network_op2(Op2()), card).modes.n_residuals == n_residuals
    assert read(network_op2(Op2(), residual_flags=(2,)), card).modes.n_residuals == n_residuals


def test_residual_vectors_that_are_there_but_not_which_are_told(read):
    component = read(network_op2(Op2(), residual_flags=(2,)))
    assert component.modes.n_residuals == 0
    assert any("does not say how many" in note for note in component.notes)
    assert not read(network_op2(Op2())).notes


def test_a_body_has_the_residual_vectors_of_its_file(tmp_path, capsys):
    (tmp_path / "a.op2").write_bytes(network_op2(Op2(), residual_flags=(1, 2)))
    folder = str(tmp_path / "vehicle")
    files = ["import", str(tmp_path / "a.op2"), "--output", folder, "--units", "mm-t-s"]
    assert main([*files, "--attach", "11"]) == 0
    (body,) = read_vehicle(folder).bodies
    assert (body.n_residuals, body.n_normal) == (4, 20)
    assert "6 rigid and 14 elastic modes, 4 residual vectors" in capsys.readouterr().out


@pytest.fixture
def imported(tmp_path):
    (tmp_path / "block.unv").write_text(network_unv(n_modes=14))

    def imported(*options, units="mm-t-s"):
        folder = tmp_path / "vehicle"
        common = ["--output", str(folder), "--units", units, "--attach", "a=11", "--attach", "b=24"]
        status = main(["import", str(tmp_path / "block.unv"), *common, *options])
        return read_vehicle(folder).bodies[0] if status == 0 else folder.exists()

    return imported


@pytest.mark.parametrize(("units", "si"), [("mm-t-s", 1e-3), ("m-kg-s", 1.0), ("mm-kg-mN", 1.0)])
def test_compliance_is_given_in_the_units_of_the_file(imported, units, si):
    """mm/N of mm-t-s; m/N; mm/mN, which is m/N too."""
    body = imported("--residual", "a=0.02,0,0.05", "--residual", "b = 0, 1e-3, 0", units=units)
    assert body.n_residuals == 3
    found = [np.diag(body.residual_compliance(name)) / si for name in "ab"]
    np.testing.assert_allclose(found, [[0.02, 0, 0.05], [0, 1e-3, 0]], rtol=1e-9, atol=0)


def test_compliance_may_stand_in_a_table(imported, tmp_path):
    path = tmp_path / "local.csv"
    path.write_text("\ufeffAttachment, x, y, z\r\na,0.02,,0.05\r\n\r\nb,0,1e-3,0\r\n", "utf-8")
    body = imported("--residual", str(path))
    found = [np.diag(body.residual_compliance(name)) * 1e3 for name in "ab"]
    np.testing.assert_allclose(found, [[0.02, 0, 0.05], [0, 1e-3, 0]], rtol=1e-9, atol=0)


def test_an_import_without_residual_vectors_says_what_that_does(imported, capsys):
    imported()
    said = capsys.readouterr()
    assert "body 'block' lacks residual vectors, so it is too stiff at 'a', 'b': on mounts" in said.err
    assert "without the last 2 of its 8 elastic modes" in said.err
    assert "with those left out" in said.out


def test_an_import_with_some_residual_vectors_does_not_say_that_it_lacks_them(imported, capsys):
    imported("--residual", "a=1,1,0", "--residual", "b=1,1,1")
    said = capsys.readouterr()
    assert (
        "body 'block' gives way too little along some directions even with its 5 residual" in said.err
    )
    assert "so it is too stiff at 'a': on mounts" in said.err
    assert "lacks residual vectors" not in said.err
    assert "its modes and residual vectors are [" in said.out


def test_an_import_with_given_compliance_says_nothing_of_that(imported, capsys):
    imported("--residual", "a=1,1,1", "--residual", "b=1,1,1")
    said = capsys.readouterr()
    assert "residual vectors, so" not in said.err
    assert "6 residual vectors" in said.out


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (["a=1,2"], "found 'a=1,2', expected a name and three compliances"),
        (["a=1,2,-3"], "none below zero"),
        (["a=1,2,nan"], "none below zero"),
        (["a=x,2,3"], "expected a name and three compliances"),
        (["c=1,2,3"], "unknown attachment 'c': there are a, b"),
        (["a=1,2,3", "a=1,2,3"], "residual compliance of 'a' is there twice"),
        (["0.001"], "found '0.001', expected NAME=X,Y,Z"),
        (["nothing.csv"], "nothing.csv: there is no such file"),
    ],
)
def test_wrong_compliance_is_refused(imported, capsys, given, words):
    assert imported(*(word for text in given for word in ("--residual", text))) is False
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert words in line
    assert "--residual" in line


@pytest.mark.parametrize(
    "text", ["", "a,1,2,3\n", "attachment,x,y\na,1,2\n", "attachment,x,y,z\na,1\n"]
)
def test_a_wrong_table_of_compliance_is_refused(imported, capsys, tmp_path, text):
    (tmp_path / "local.csv").write_text(text)
    assert imported("--residual", str(tmp_path / "local.csv")) is False
    assert "local.csv: found" in capsys.readouterr().err
