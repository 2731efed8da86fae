"""Two components out of files of another program, joined, against their full matrices."""

import numpy as np
import pytest
from op2_files import MODES, Op2
from two_sheets import Sheet, direct_frequencies, mount_stiffness, sheets

from modeviz.cli import main
from modeviz.fem.attachments import unit_loads
from modeviz.fem.free import free_modes
from modeviz.fem.residuals import residual_vectors

N = 24
OP2 = Op2("<", 8)


def op2_file(sheet: Sheet, with_residuals: bool) -> bytes:
    """Free modes, and residual vectors for forces at the points, in mm and t, in double precision."""
    matrices = sheet.matrices
    modes = free_modes(matrices, N)
    loads = matrices.motion.T @ unit_loads(sheet.points, matrices.nodes)
    residuals = residual_vectors(matrices, modes, loads)
    shapes = matrices.motion @ np.hstack([modes.shapes, residuals.shapes])
    scale = np.sqrt(1000) * np.repeat([1.0, 1e-3], 3)  # of 1/√kg and 1/(m √kg)
    shapes = scale[:, None] * shapes.reshape(len(matrices.nodes), 6, -1)
    squares = np.r_[modes.omega_n_squared, residuals.omega_n_squared]
    last = len(squares) if with_residuals else N
    ids = np.arange(1, len(matrices.nodes) + 1)
    grids = [(int(i), 0, place, 0) for i, place in zip(ids, 1000 * matrices.nodes, strict=True)]
    rows = [(mode + 1, squares[mode], 0.0, 1.0) for mode in range(last)]
    records = []
    for mode in range(last):
        records += [OP2.header(MODES, mode + 1, squares[mode]), OP2.shape(ids, shapes[..., mode])]
    flags = ((1, N), (2, last)) if with_residuals else ((0, N),)
    return OP2.file(
        OP2.table("GEOM1", OP2.grids(grids)),
        *(OP2.table("LAMA", *OP2.eigenvalues(*rows[:n], residual_flag=flag)) for flag, n in flags),
        OP2.table("OUGV1", *records),
    )


@pytest.fixture
def joined(tmp_path, printed_json, capsys):
    """Frequencies of both sheets, imported and joined by mounts, and what was said."""

    def joined(with_residuals, stiffness):
        folder = tmp_path / "vehicle"
        for sheet in sheets():
            path = tmp_path / f"{sheet.name}.op2"
            path.write_bytes(op2_file(sheet, with_residuals))
            attach = [
                f"m{i}={point.node + 1}@{','.join(map(repr, (1000 * point.position).tolist()))}"
                for i, point in enumerate(sheet.points)
            ]
            options = [word for place in attach for word in ("--attach", place)]
            common = ["--output", str(folder), "--units", "mm-t-s"]
            assert main(["import", str(path), *common, *options]) == 0
        with (folder / "vehicle.toml").open("a") as toml:
            for i, (point, k) in enumerate(zip(sheets()[0].points, stiffness / 1000, strict=True)):
                toml.write(
                    f'[[spring]]\nname = "s{i}"\nbodies = ["floor", "roof"]\n'
                    f"at = {point.position.tolist()}\nstiffness = {k.tolist()}\n"
                )
        said = capsys.readouterr().err
        main(["check", str(folder)])
        said += capsys.readouterr().out
        modes = printed_json("modes", str(folder), "--below", "150")["modes"]
        return np.array([mode["frequency_hz"] for mode in modes]), said

    return joined


@pytest.mark.parametrize("part", [0.3, 1.5])
def test_with_residual_vectors_they_have_the_frequencies_of_their_full_matrices(joined, part):
    stiffness = mount_stiffness(part)
    found, said = joined(True, stiffness)
    below = 0.5 * min(sheet.body(N).natural_frequency_hz[-1] for sheet in sheets())
    found = found[(found > 0.5) & (found < below)]
    np.testing.assert_allclose(found, direct_frequencies(stiffness)[6 : 6 + len(found)], rtol=1e-6)
    assert len(found) > 15
    assert "lacks residual vectors" not in said


def test_without_them_they_are_too_high_and_the_mounts_that_feel_it_are_named(joined):
    stiffness = mount_stiffness(1.5)
    found, said = joined(False, stiffness)
    found = found[found > 0.5][:10]
    exact = direct_frequencies(stiffness)[6:16]
    assert (found > exact).all()
    assert (found / exact - 1).max() > 1e-3
    assert "body 'floor' lacks residual vectors, so it is too stiff at 'm0', 'm1', 'm2'" in said
    assert (
        "doubt: body 'roof' lacks residual vectors where connections are stiffer than a tenth" in said
    )
    assert "'s0' (z)" in said
