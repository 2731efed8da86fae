"""Ansys's files: those that ansys-mapdl-reader comes with, and arrays as it makes them of others."""

import subprocess
import sys
from itertools import product
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg
from ansys.mapdl.reader import examples
from free_network import CORNERS, HEXA, LABELS, free_network
from two_networks import ATTACHED, joined_frequencies

from modeviz.cli import main
from modeviz.cli.importing.listing import listing
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.formats.ansys import reader
from modeviz.formats.body import uncoupled_because
from modeviz.formats.reading import read_component
from modeviz.formats.solving import Wanted, solved

BEAM_HZ = [7366.49503969, 7366.49503969, 11504.89523664, 17285.70459456, 17285.70459457, 20137.19299035]
"""Of the library's example, as Ansys 15 wrote them: a clamped beam of quadratic solids."""

FULL_HZ = [1283.20036921, 1283.20036921, 5781.97486169, 6919.39887714, 6919.39887714, 10172.61497694]
"""Of its matrices of such a beam, clamped at one end, as its user guide has them."""

NETWORK = free_network()
M, K = NETWORK.mass, NETWORK.stiffness


@pytest.fixture(scope="module")
def beam():
    return read_component([Path(examples.rstfile)])


def test_results_have_nodes_solids_and_modes(beam):
    np.testing.assert_allclose(beam.modes.frequency_hz, BEAM_HZ, rtol=1e-10)
    assert len(beam.node_ids) == 321
    assert beam.elements["hexa"].shape == (40, 8)
    assert not beam.modes.shapes[:, 3:].any()
    np.testing.assert_array_equal(beam.modes.modal_mass, 1)
    assert "7366.5" in listing(beam)


EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
"""Of a solid of 20 nodes, as VTK has them: in their midst are its further nodes."""


def interpolation(x):
    """Of a solid of 20 nodes at x, y, z from -1 to 1, (20,): Zienkiewicz, "Serendipity" family."""
    square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    corners = np.array([(*p, z) for z in (-1, 1) for p in square])
    middles = np.array([(corners[a] + corners[b]) // 2 for a, b in EDGES])
    at_corners = np.prod(1 + corners * x, axis=1) * (corners @ x - 2) / 8
    at_middles = np.prod(np.where(middles == 0, 1 - x**2, 1 + middles * x), axis=1) / 4
    return np.r_[at_corners, at_middles]


def test_the_modal_masses_of_results_are_those_of_the_solids_they_are_of():
    """The example is of 40 cuboids of 20 nodes, 1 by 1 by 5 in, with a density of 4.1408e-4."""
    arrays = reader._arrays(Path(examples.rstfile))
    cells = arrays["cells"].reshape(40, 21)[:, 1:]
    points, weights = (list(product(some, repeat=3)) for some in np.polynomial.legendre.leggauss(3))
    N = np.array([interpolation(np.array(x)) for x in points])
    unit = N.T @ (np.prod(weights, axis=1)[:, None] * N) / 8
    mass = np.zeros((321, 321))
    for cell in cells:
        mass[np.ix_(cell, cell)] += 4.1408e-4 * np.prod(np.ptp(arrays["nodes"][cell], axis=0)) * unit
    assert mass.sum() == pytest.approx(5 * 4.1408e-4)
    modal = np.einsum("mnd,np,mpd->m", arrays["shapes"], mass, arrays["shapes"])
    np.testing.assert_allclose(modal, 1, rtol=5e-5)  # Ansys integrates at 14 points


def test_results_of_free_bodies_couple_as_their_full_matrices_do(read, tmp_path):
    """Of modes that are normalised to mass, all that there are."""
    shapes = NETWORK.shapes.transpose(2, 0, 1)
    read(results=result_arrays(frequencies=NETWORK.frequency_hz, shapes=shapes))
    (tmp_path / "a.rst").write_bytes(b"")
    attach = [word for node in ATTACHED for word in ("--attach", str(node))]
    folder = str(tmp_path / "v")
    for name in ("upper", "lower"):
        path = str((tmp_path / "a.rst").rename(tmp_path / f"{name}.rst"))
        assert main(["import", path, "--output", folder, "--units", "mm-t-s", *attach]) == 0
        (tmp_path / "a.rst").write_bytes(b"")
    header = "name,node 1,node 2,body 1,body 2,kx [N/mm],ky [N/mm],kz [N/mm]"
    rows = [f"m{n},{n},{n},upper,lower,10,20,30" for n in ATTACHED]
    table = tmp_path / "m.csv"
    table.write_text("\n".join([header, *rows]))
    assert main(["import", str(table), "--output", folder]) == 0
    expected = joined_frequencies([(n, np.diag([10.0, 20.0, 30.0])) for n in ATTACHED])
    found = solve_modes(assemble(read_vehicle(tmp_path / "v"))).frequency_hz
    np.testing.assert_allclose(found[6:], expected[6:], rtol=1e-6)


@pytest.mark.parametrize("rotations", [0.01, 7.0])
def test_modes_with_a_largest_motion_of_one_have_no_known_mass(read, rotations):
    shapes = NETWORK.shapes.transpose(2, 0, 1)
    shapes = shapes / np.abs(shapes).max(axis=(1, 2), keepdims=True)
    shapes = np.concatenate([shapes, rotations * shapes], axis=2)
    names = np.array(reader.DIRECTIONS)
    component = read(
        results=result_arrays(frequencies=NETWORK.frequency_hz, shapes=shapes, directions=names)
    )
    assert "modal mass of 24 of its 24 modes is not in the file" in uncoupled_because(component)
    assert "Nrmkey of MODOPT" in component.notes[0]


def test_a_full_file_has_the_matrices_of_its_known_modes():
    """The library's example is clamped at an end: what is free of it vibrates as its manual says."""
    arrays = reader._arrays(Path(examples.fullfile))
    mass, stiffness = np.zeros((2, 963, 963))
    for name, A in (("M", mass), ("K", stiffness)):
        A[arrays[f"{name}_row"], arrays[f"{name}_col"]] = arrays[f"{name}_data"]
    free = np.flatnonzero(mass.diagonal())
    mass, stiffness = ((A + np.triu(A, 1).T)[np.ix_(free, free)] for A in (mass, stiffness))
    omega_squared = scipy.linalg.eigh(stiffness, mass, eigvals_only=True)
    np.testing.assert_allclose(np.sqrt(omega_squared[:6]) / (2 * np.pi), FULL_HZ, rtol=1e-7)


def test_a_full_file_with_supports_is_refused():
    with pytest.raises(VehicleError, match="directions are held, such as that of node 1"):
        read_component([Path(examples.fullfile), Path(examples.rstfile)])


def full_arrays(**changed):
    """As the library gives the upper half of matrices."""
    arrays = {"dofs": np.column_stack([np.repeat(LABELS, 3), np.tile([0, 1, 2], 8)])}
    arrays["held"] = np.zeros((0, 2), int)
    for name, A in (("K", K), ("M", M)):
        rows, columns = np.nonzero(np.triu(A))
        arrays |= {f"{name}_row": rows, f"{name}_col": columns, f"{name}_data": A[rows, columns]}
    return arrays | changed


def result_arrays(**changed):
    cells = np.r_[8, np.searchsorted(LABELS, HEXA), 2, 0, 1]
    return {
        "analysis": np.array(2),
        "is_cyclic": np.array(False),
        "is_complex": np.array(False),
        "is_whole": np.array(True),
        "nodes": CORNERS,
        "numbers": LABELS,
        "angles": np.zeros((8, 3)),
        "cells": cells,
        "kinds": np.array([12, 3]),
        "frequencies": np.array([2.0, 1.0]),
        "directions": np.array(["UX", "UY", "UZ"]),
        "shapes": np.arange(1.0, 49.0).reshape(2, 8, 3),
    } | changed


@pytest.fixture
def read(tmp_path, monkeypatch):
    """Reads arrays as if the library's process had left them."""

    def read(full=None, results=None):
        found = {".full": full, ".rst": results or result_arrays()}
        monkeypatch.setattr(reader, "_arrays", lambda path: found[path.suffix])
        paths = [tmp_path / f"a{suffix}" for suffix, arrays in found.items() if arrays is not None]
        return read_component(paths)

    return read


def test_matrices_with_the_geometry_of_results(read):
    component = solved(read(full_arrays()), Wanted(n_modes=20))
    exact = np.sqrt(scipy.linalg.eigh(K, M, eigvals_only=True)[6:]) / (2 * np.pi)
    np.testing.assert_allclose(component.modes.frequency_hz[6:], exact[:14], rtol=1e-9)
    assert component.elements["hexa"].tolist() == [[0, 1, 3, 2, 4, 5, 7, 6]]


@pytest.mark.parametrize(("column", "plane"), [(0, (0, 1)), (1, (1, 2)), (2, (2, 0))])
def test_matrices_are_along_the_axes_of_turned_nodes(read, column, plane):
    """THXY turns x towards y, THYZ y towards z, THZX z towards x."""
    angles = np.zeros((8, 3))
    angles[:, column] = np.arange(8) * 10.0
    first, second = plane
    turns = np.tile(np.eye(3), (8, 1, 1))
    c, s = np.cos(np.radians(angles[:, column])), np.sin(np.radians(angles[:, column]))
    turns[:, first, first], turns[:, second, first] = c, s
    turns[:, first, second], turns[:, second, second] = -s, c
    T = scipy.linalg.block_diag(*turns)
    arrays = full_arrays()
    for name, A in (("K", T.T @ K @ T), ("M", T.T @ M @ T)):
        rows, columns = np.triu_indices(24)
        arrays |= {f"{name}_row": rows, f"{name}_col": columns, f"{name}_data": A[rows, columns]}
    component = solved(read(arrays, result_arrays(angles=angles)), Wanted(n_modes=20))
    exact = np.sqrt(scipy.linalg.eigh(K, M, eigvals_only=True)[6:]) / (2 * np.pi)
    np.testing.assert_allclose(component.modes.frequency_hz[6:], exact[:14], rtol=1e-9)


def test_modes_come_in_the_order_of_their_frequencies(read):
    component = read()
    assert component.modes.frequency_hz.tolist() == [1.0, 2.0]
    assert component.modes.shapes[0, :3].tolist() == [[25.0, 1.0], [26.0, 2.0], [27.0, 3.0]]


def wrong(value, where=(0, 0, 0)):
    shapes = np.arange(1.0, 49.0).reshape(2, 8, 3)
    shapes[where] = value
    return shapes


@pytest.mark.parametrize(
    ("full", "results", "words"),
    [
        (None, {"shapes": wrong(1e172)}, "write it again after /FCOMP,RST,0"),
        (None, {"shapes": wrong(np.nan)}, "write it again after /FCOMP,RST,0"),
        (None, {"shapes": wrong(0.0, np.s_[1, 3:])}, "write it again after /FCOMP,RST,0"),
        (None, {"analysis": np.array(0)}, "another analysis than a modal one"),
        (None, {"is_cyclic": np.array(True)}, "a cyclic sector"),
        (None, {"is_complex": np.array(True)}, "its modes are complex"),
        (None, {"is_whole": np.array(False)}, "motions of some of its nodes only"),
        (None, {"directions": np.array(["UX", "UY", "TEMP"])}, "results of UX, UY, TEMP"),
        (None, {"angles": np.full((8, 3), 10.0)}, "turned about several axes"),
        ({"K_data": full_arrays()["K_data"] * 1e172}, {}, "numbers beyond 1e\\+30"),
        ({"K_data": full_arrays()["K_data"] * 0}, {}, "nothing on its diagonal at node 11"),
        ({"M_data": np.zeros(0), "M_row": np.zeros(0), "M_col": np.zeros(0)}, {}, "M: has no entries"),
        ({"held": np.array([[12, 2]])}, {}, "1 directions are held, such as that of node 12"),
        ({"dofs": np.full((24, 2), 8)}, {}, "directions other than motions"),
    ],
)
def test_what_the_library_reads_wrongly_is_refused(read, full, results, words):
    with pytest.raises(VehicleError, match=words):
        read(None if full is None else full_arrays(**full), result_arrays(**results))


@pytest.mark.parametrize(
    ("name", "damage"),
    [
        ("a.rst", lambda content: content[:1000]),
        ("a.rst", lambda content: content[:400] + b"\xff" * 4000 + content[4400:]),
        ("a.full", lambda content: content[:2000] + b"\x7f" * 8000 + content[10000:]),
    ],
)
def test_damaged_files_are_refused_in_a_sentence(tmp_path, name, damage, capsys):
    path = tmp_path / name
    source = examples.rstfile if name.endswith("rst") else examples.fullfile
    path.write_bytes(damage(Path(source).read_bytes()))
    paths = [path] if name.endswith("rst") else [path, Path(examples.rstfile)]
    assert main(["import", *map(str, paths)]) == 2
    said = capsys.readouterr().err
    assert "Traceback" not in said
    assert len(said.strip().splitlines()) == 1


@pytest.mark.parametrize("content", [b"", b"d", b"x" * 1000])
def test_what_is_empty_or_none_of_ansys_is_told_so(tmp_path, content):
    path = tmp_path / "a.rst"
    path.write_bytes(content)
    with pytest.raises(VehicleError, match=r"a\.rst: is empty or no binary file of Ansys"):
        read_component([path])


HEADER = b"\x64\0\0\0"


@pytest.mark.skipif(sys.platform == "win32", reason="has no such limit")
def test_a_process_that_takes_too_much_memory_is_ended(tmp_path, monkeypatch):
    monkeypatch.setattr(reader.extract, "__file__", str(tmp_path / "extract.py"))
    ending = Path(__file__).parents[2].joinpath("modeviz/formats/ansys/extract.py").read_text()
    reading = "def main(*_):\n    bytes(5_000_000_000)\n\n\ndef run("
    (tmp_path / "extract.py").write_text(ending.replace("def run(", reading))
    (tmp_path / "a.rst").write_bytes(HEADER)
    with pytest.raises(VehicleError, match=r"more than 4,000,000,000 bytes.*MODEVIZ_LIMIT=2"):
        read_component([tmp_path / "a.rst"])


def test_a_process_that_does_not_end_is_ended(tmp_path, monkeypatch):
    def late(command, **options):
        raise subprocess.TimeoutExpired(command, options["timeout"])

    monkeypatch.setattr(reader.subprocess, "run", late)
    (tmp_path / "a.rst").write_bytes(HEADER)
    with pytest.raises(VehicleError, match="is not read within 60 s"):
        read_component([tmp_path / "a.rst"])


def test_without_the_library_it_is_named(tmp_path, monkeypatch):
    def missing(command, **options):
        return subprocess.CompletedProcess(command, 1, b"", b"missing: No module named 'ansys'\n")

    monkeypatch.setattr(reader.subprocess, "run", missing)
    (tmp_path / "a.rst").write_bytes(HEADER)
    with pytest.raises(VehicleError, match=r"pip install 'modeviz\[ansys\]'"):
        read_component([tmp_path / "a.rst"])
