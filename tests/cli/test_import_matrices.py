"""Components made of mass and stiffness matrices, from files to a vehicle that is solved."""

import numpy as np
import pytest
import scipy.io
import scipy.sparse as sp
from matrix_files import beam, joined_frequencies, ribbed_panel, write_table

from modeviz.cli import main
from modeviz.files import read_vehicle

SPRINGS = [(101, 101, (3e5, 2e5, 5e5)), (164, 119, (3e5, 2e5, 5e5)), (129, 109, (1e4, 2e4, 4e4))]
"""Between nodes of the panel and of the beam at the same place: along x, y and z, N/m."""


@pytest.fixture(scope="module")
def structures():
    return {"panel": ribbed_panel(), "beam": beam()}


def write_npz(folder, name, A):
    path = folder / f"{name}.npz"
    sp.save_npz(path, A)
    return path


def write_market(folder, name, A):
    path = folder / f"{name}.mtx"
    scipy.io.mmwrite(path, A, symmetry="symmetric", precision=17)
    return path


def import_one(folder, name, structure, nodes, write, *options):
    """Imports a structure, whose files stand beside the vehicle folder."""
    M, K, _ = structure.in_mm_t_s()
    files = [write(folder, f"{name}_K", K), write(folder, f"{name}_M", M)]
    table = write_table(folder / f"{name}.csv", structure)
    attach = [part for node in nodes for part in ("--attach", f"node {node}={node}")]
    arguments = ["import", *files, table, "--output", folder / "vehicle", "--units", "mm-t-s"]
    assert main([*map(str, arguments), "--name", name, *attach, *options]) == 0


def add_springs(folder, structures):
    with (folder / "vehicle" / "vehicle.toml").open("a") as file:
        for number, (one, _, stiffness) in enumerate(SPRINGS):
            place = structures["panel"].matrices.nodes[one - 101].tolist()
            file.write(
                f'[[spring]]\nname = "spring {number}"\nbodies = ["panel", "beam"]\nat = {place}\n'
                f"stiffness = {[k / 1000 for k in stiffness]}\n"
            )


@pytest.mark.parametrize("write", [write_npz, write_market])
def test_bodies_of_matrices_couple_as_their_full_matrices_do(tmp_path, structures, printed_json, write):
    """Below half of the highest frequency that both keep, within 1e-6."""
    import_one(tmp_path, "panel", structures["panel"], [101, 164, 129], write, "--modes", "30")
    import_one(tmp_path, "beam", structures["beam"], [101, 119, 109], write, "--modes", "20")
    add_springs(tmp_path, structures)
    kept = [b.natural_frequency_hz[b.n_normal - 1] for b in read_vehicle(tmp_path / "vehicle").bodies]
    exact = joined_frequencies(list(structures.values()), SPRINGS)
    exact = exact[(exact > 1) & (exact < min(kept) / 2)]
    record = printed_json("modes", str(tmp_path / "vehicle"), "--below", str(min(kept) / 2))
    found = np.array([mode["frequency_hz"] for mode in record["modes"]])
    assert len(exact) >= 10
    np.testing.assert_allclose(found[found > 1], exact, rtol=1e-6)


@pytest.mark.parametrize("method", ["guyan", "craig-bampton"])
def test_condensed_bodies_couple_as_the_full_ones_do_but_for_what_is_left_out(
    tmp_path, structures, printed_json, capsys, method
):
    """Up to 100 Hz within a hundredth and never too low, of 150 Hz that were asked for."""
    options = ("--up-to", "150", "--condense", method)
    import_one(tmp_path, "panel", structures["panel"], [101, 164, 129], write_npz, *options)
    import_one(tmp_path, "beam", structures["beam"], [101, 119, 109], write_npz, *options)
    said = capsys.readouterr().err
    assert "note: condensed from 420 to" in said
    assert "18 of them at attachments" in said
    add_springs(tmp_path, structures)
    record = printed_json("modes", str(tmp_path / "vehicle"), "--below", "100")
    found = np.array([mode["frequency_hz"] for mode in record["modes"]])
    exact = joined_frequencies(list(structures.values()), SPRINGS)
    exact = exact[(exact > 1) & (exact < 100)]
    too_high = found[found > 1] / exact[: (found > 1).sum()] - 1
    assert ((too_high > -1e-7) & (too_high < 1e-2)).all()
    assert len(too_high) >= 6


def test_a_list_of_what_matrices_have_needs_no_folder(tmp_path, structures, capsys):
    M, K, _ = structures["beam"].in_mm_t_s()
    files = [write_npz(tmp_path, "K", K), write_npz(tmp_path, "M", M)]
    table = write_table(tmp_path / "nodes.csv", structures["beam"])
    assert main(["import", *map(str, files), str(table), "--up-to", "200"]) == 0
    said = capsys.readouterr().out
    assert "19 nodes, no elements; units unknown" in said
    assert "It can be coupled to others" in said
    assert "113.46" in said


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--modes", "3"), "--modes: found 3, expected 7"),
        (("--modes", "30", "--up-to", "50"), "found both, expected one"),
        (("--up-to", "-1"), "--up-to: found -1 Hz"),
        (("--condense", "guyan"), "nothing says up to which frequency"),
        (("--up-to", "50", "--condense", "craig-bampton", "--attach", "101=101"), ""),
        (("--up-to", "50", "--condense", "craig-bampton"), "don't hold the body"),
        (("--up-to", "1e9"), ""),
    ],
)
def test_wishes_that_cannot_be_are_refused_in_a_sentence(tmp_path, structures, capsys, options, words):
    M, K, _ = structures["beam"].in_mm_t_s()
    files = [write_npz(tmp_path, "K", K), write_npz(tmp_path, "M", M)]
    table = write_table(tmp_path / "nodes.csv", structures["beam"])
    arguments = [
        "import",
        *files,
        table,
        "--output",
        tmp_path / "vehicle",
        "--units",
        "mm-t-s",
        *options,
    ]
    assert main(list(map(str, arguments))) == (2 if words else 0)
    said = capsys.readouterr().err
    assert words in said
    assert "Traceback" not in said
