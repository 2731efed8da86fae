from pathlib import Path

import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.formats.nastran import read_nastran

SHARED = Path(__file__).parents[3] / "shared/data/s1_msc_modes_bdf_op2_f06"
NAME = "mode_solid_shell_bar"
DECK = "".join(f"GRID,{i},,{i}.,0.,0.\n" for i in (1, 2, 3))
MOTIONS = np.arange(36.0).reshape(2, 3, 6) - 20
EIGENVALUES = (100.0, 400.0)


def page(*lines: str, subcase: int = 1) -> str:
    head = f"1    A FRAME{'':60}OCTOBER  19, 2015  MSC.NASTRAN  6/17/05   PAGE    13"
    return "\n".join([head, "     DEFAULT", f"0{'':104}SUBCASE {subcase:<13}", *lines, ""])


def mode(number: int, value: float, rows: list[str], subcase: int = 1) -> str:
    hertz = value**0.5 / 6.2832
    what = f"R E A L   E I G E N V E C T O R   N O . {number:10d}"
    return page(
        f"      EIGENVALUE = {value:13.6E}",
        f"          CYCLES = {hertz:13.6E}         {what}",
        " ",
        "      POINT ID.   TYPE          T1             T2             T3             R1",
        *rows,
        subcase=subcase,
    )


def row(grid: int, motion, kind: str = "G") -> str:
    numbers = "".join(f"{v:15.6E}" for v in motion)
    return f"{grid:14d}      {kind}  {numbers}"


def eigenvalues(*masses: float) -> str:
    rows = [
        f"{n:9d}{n:10d}{w2:20.6E}{w2**0.5:20.6E}{w2**0.5 / 6.2832:20.6E}{m:20.6E}{m * w2:20.6E}"
        for n, (w2, m) in enumerate(zip(EIGENVALUES, masses, strict=True), 1)
    ]
    heads = [
        "                    R E A L   E I G E N V A L U E S",
        "   MODE    EXTRACTION      EIGENVALUE            RADIANS             CYCLES",
        "    NO.       ORDER",
    ]
    return page(*heads, *rows)


@pytest.fixture
def read(tmp_path):
    def read(text: str):
        (tmp_path / "a.f06").write_text(text, encoding="latin-1")
        (tmp_path / "a.bdf").write_text(DECK)
        return read_nastran([tmp_path / "a.f06", tmp_path / "a.bdf"])

    return read


def printed(n_rows: int = 3) -> str:
    """Two modes, of which each goes on over the page after so many rows."""
    text = "     SOL 103\n" + eigenvalues(2.0, 3.0)
    for n, value in enumerate(EIGENVALUES):
        rows = [row(i + 1, MOTIONS[n, i]) for i in range(3)]
        text += mode(n + 1, value, rows[:n_rows])
        if rows[n_rows:]:
            text += mode(n + 1, value, rows[n_rows:])
    return text


@pytest.mark.shared
def test_printed_modes_of_msc_nastran_are_those_of_its_op2_file():
    deck = SHARED / f"{NAME}.bdf"
    printed_, written = (read_nastran([SHARED / f"{NAME}.{end}", deck]).modes for end in ("f06", "op2"))
    np.testing.assert_allclose(printed_.shapes, written.shapes, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(printed_.frequency_hz, written.frequency_hz, rtol=1e-6)
    np.testing.assert_array_equal(printed_.modal_mass, 1)


@pytest.mark.parametrize("n_rows", [1, 2, 3])
def test_modes_that_go_on_over_pages(read, n_rows):
    component = read(printed(n_rows))
    np.testing.assert_allclose(component.modes.shapes, MOTIONS.transpose(1, 2, 0))
    np.testing.assert_allclose(component.modes.frequency_hz, np.array([10, 20]) / (2 * np.pi))
    np.testing.assert_array_equal(component.modes.modal_mass, [2, 3])
    np.testing.assert_array_equal(component.nodes[:, 0], [1, 2, 3])


def test_a_file_that_ends_before_its_modes_is_cut_unless_the_job_ended(read):
    text = printed()
    fewer = text[: text.rindex(page("").split("\n")[0])]
    with pytest.raises(
        VehicleError, match=r"mode 2 of its table .* no line END OF JOB: the file is cut"
    ):
        read(fewer)
    assert read(fewer + page(" * * * END OF JOB * * *")).n_modes == 1


def test_grids_without_rotations_and_scalar_points(read):
    rows = [row(1, [1, 2, 3]), row(2, [4, 5, 6]), row(3, [7, 8, 9]), row(4, [9, 9, 9], "S")]
    component = read(mode(1, 100.0, rows))
    assert component.modes.shapes[:, :, 0].tolist() == [
        [1, 2, 3, 0, 0, 0], [4, 5, 6, 0, 0, 0], [7, 8, 9, 0, 0, 0],
    ]  # fmt: skip
    assert any("3 scalar points" in note for note in component.notes)


def test_other_subcases_are_left_out_and_told(read):
    rows = [row(i, MOTIONS[0, 0]) for i in (1, 2, 3)]
    component = read(mode(1, 100.0, rows) + mode(1, 900.0, rows, subcase=2))
    assert component.n_modes == 1
    assert any("1 modes of other subcases than 1" in note for note in component.notes)


def test_modes_that_buckle_are_none(read):
    assert read(printed().replace("SOL 103", "SOL 105")).n_modes == 0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            printed().replace("R E A L   E I G E N V E C", "C O M P L E X   E I G E N V E C"),
            "are complex",
        ),
        (printed()[:-15], "found 5 numbers, expected 3 or 6"),
        (printed().replace("-2.000000E+01", "-2.00*000E+01"), "expected numbers"),
        (printed().replace("-2.000000E+01", "          NaN"), "not finite"),
        (printed().replace("EIGENVALUE =  1.0", "EIGENVALUE =  +.-"), "expected numbers"),
        (printed().replace("             2      G", "             1      G", 1), "moves grid 1 twice"),
        (mode(1, 100.0, []), "is the file cut?"),
    ],
)
def test_damaged_printed_files_are_refused_in_a_sentence(read, text, words):
    with pytest.raises(VehicleError) as caught:
        read(text)
    assert words in str(caught.value)
    assert "a.f06: " in str(caught.value)
