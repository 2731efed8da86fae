import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.formats.reading import read_component

DECK = "EIGRL,1,,,2\n" + "".join(f"GRID,{i},,{i}.,0.,0.\n" for i in (1, 2, 3))


def lines(numbers, first: str) -> list[str]:
    """Of a point: three numbers each, 18 columns wide."""
    rows = np.reshape(numbers, (-1, 3))
    heads = [first, *["-CONT-"] * (len(rows) - 1)]
    return [
        f"{head:18}" + "".join(f"{v:18.6E}" for v in row) for head, row in zip(heads, rows, strict=True)
    ]


def mode(number: int, eigenvalue: str, points, form="REAL OUTPUT", subcase=1) -> list[str]:
    """The lines of a mode, as MSC Nastran writes them, of points with their kind and numbers."""
    text = ["$TITLE   = A FRAME", "$SUBTITLE=", "$LABEL   =", "$EIGENVECTOR", f"${form}"]
    text += [f"$SUBCASE ID ={subcase:12d}", f"$EIGENVALUE = {eigenvalue} MODE ={number:6d}"]
    for grid, kind, numbers in points:
        text += lines(numbers, f"{grid:10d}{kind:>8}")
    return text


def punched(*modes: list[str]) -> str:
    every = [line for one in modes for line in one]
    return "".join(f"{line:72}{number:8d}\n" for number, line in enumerate(every, 1))


@pytest.fixture
def read(tmp_path):
    def read(text: str, deck: str = DECK):
        (tmp_path / "a.pch").write_text(text)
        (tmp_path / "a.bdf").write_text(deck)
        return read_component([tmp_path / "a.pch", *([tmp_path / "a.bdf"] if deck else [])])

    return read


MOTIONS = np.arange(36.0).reshape(2, 3, 6) - 20


def two_modes() -> list[list[str]]:
    return [
        mode(n + 1, f"{value:14.7E} ", [(i + 1, "G", MOTIONS[n, i]) for i in range(3)])
        for n, value in enumerate((100.0, 400.0))
    ]


def test_modes_of_a_punch_file_with_the_geometry_of_the_input(read):
    component = read(punched(*two_modes()))
    np.testing.assert_allclose(component.modes.frequency_hz, np.array([10, 20]) / (2 * np.pi))
    np.testing.assert_allclose(component.modes.shapes, MOTIONS.transpose(1, 2, 0))
    np.testing.assert_array_equal(component.nodes[:, 0], [1, 2, 3])
    np.testing.assert_array_equal(component.modes.modal_mass, 1)  # EIGRL's are normalised to MASS


def test_scalar_points_displacements_and_other_subcases_are_left_out(read):
    points = [(1, "G", MOTIONS[0, 0]), (9, "S", [7.0, 0, 0, 0, 0, 0])]
    still = [line.replace("EIGENVECTOR", "DISPLACEMENTS") for line in mode(1, "1.0", points)]
    other = mode(1, "900.0", points, subcase=2)
    component = read(punched(still, mode(1, "100.0", points), other), deck="")
    assert component.node_ids.tolist() == [1]
    assert component.n_modes == 1
    assert any("geometry" in note for note in component.notes)


@pytest.mark.parametrize(
    ("form", "second"),
    [
        ("REAL-IMAGINARY OUTPUT", [3.0, 4, 5, 6, 7, 8]),
        ("MAGNITUDE-PHASE OUTPUT", [0, 90, 180, 0, 0, 0]),
    ],
)
def test_complex_modes_in_either_form(read, form, second):
    first = np.arange(1.0, 7.0)
    points = [(i, "G", [*first, *second]) for i in (1, 2, 3)]
    component = read(punched(mode(1, "( -3.0000000E+00,  4.0000000E+00)", points, form)))
    expected = first + 1j * np.array(second)
    if "PHASE" in form:
        expected = first * np.exp(1j * np.radians(second))
    np.testing.assert_allclose(component.modes.shapes[0, :, 0], expected, atol=1e-12)
    np.testing.assert_allclose(component.modes.damping_ratio, 3 / 5)


@pytest.mark.parametrize("numbers", [(1, 1), (1, 2)])
@pytest.mark.parametrize("real_first", [True, False])
def test_real_and_complex_modes_in_one_file_are_refused(read, numbers, real_first):
    """Also where they are parts of one mode, each with grids of its own."""
    first, second = ((i, "G", [*np.arange(1.0, 7.0), *np.arange(6.0)]) for i in (1, 2))
    grids = ([first], [second]) if numbers[0] == numbers[1] else ([first, second],) * 2
    real, imaginary = ([(i, "G", six[:6]) for i, _, six in grids[0]], grids[1])
    modes = [
        mode(numbers[0], "100.0", real),
        mode(numbers[1], "( 100.0, 0.0)", imaginary, "REAL-IMAGINARY OUTPUT"),
    ]
    with pytest.raises(VehicleError, match=r"a\.pch: mode \d: found real and complex modes"):
        read(punched(*(modes if real_first else modes[::-1])))


def test_what_a_run_for_responses_punches_is_told_apart(tmp_path):
    response = ["$TITLE   =", "$ACCELERATION", "$MAGNITUDE-PHASE OUTPUT", "$POINT ID =        7012"]
    rows = lines(np.arange(12.0), "    2.000000E+01 G")
    (tmp_path / "a.pch").write_text(punched([*response, *rows]))
    with pytest.raises(VehicleError, match=r"a\.pch: has neither modes \(\$EIGENVECTOR\) nor matrices"):
        read_component([tmp_path / "a.pch"])


def test_motions_without_end_are_refused_without_a_warning(read):
    points = [(i, "G", [np.inf, 1, 2, 3, 4, 5, *np.zeros(6)]) for i in (1, 2, 3)]
    for form in ("REAL-IMAGINARY OUTPUT", "MAGNITUDE-PHASE OUTPUT"):
        with pytest.raises(VehicleError, match="not finite"):
            read(punched(mode(1, "( -3.0000000E+00,  4.0000000E+00)", points, form)))


WHOLE = punched(*two_modes())


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (WHOLE[: len(WHOLE) - 81], "is it cut?"),
        (WHOLE[:300], "is the file cut?"),  # found at random, with an end within the headings
        (WHOLE.replace("$EIGENVALUE", "$POINT ID"), "SORT2"),
        (WHOLE.replace("1.0000000E+02", "1.000000.E+02"), "the eigenvalue '1.000000.E+02'"),
        (WHOLE.replace("         2       G", "         2        "), "expected a point and its kind"),
        (WHOLE.replace("         2       G", "         1       G"), "moves grid 1 twice"),
        (WHOLE.replace("-2.000000E+01", "          NaN"), "not finite"),
        (WHOLE.replace("-2.000000E+01", "-2.00X000E+01"), "found no numbers in columns of 18"),
        (WHOLE.replace("         3       G", "99999999999999999999 G"), "which is no number of one"),
    ],
)
def test_damaged_punch_files_are_refused_in_a_sentence(read, text, words):
    with pytest.raises(VehicleError) as caught:
        read(text)
    assert words in str(caught.value)
    assert "a.pch: " in str(caught.value)
