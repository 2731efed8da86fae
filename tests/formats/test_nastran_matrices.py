"""Matrices of Nastran: OUTPUT4, DMIG cards, punched and in input files, external superelements."""

import numpy as np
import pytest
import scipy.linalg
from free_network import CORNERS, HEXA, LABELS, free_network
from op4_files import dmig, op4_binary, op4_text

from modeviz.errors import VehicleError
from modeviz.formats.nastran import bulk, deck, input_file
from modeviz.formats.nastran.op4 import read_op4
from modeviz.formats.reading import read_component
from modeviz.formats.solving import Wanted, solved

NETWORK = free_network()
M, K = NETWORK.mass, NETWORK.stiffness
EXACT = np.sqrt(scipy.linalg.eigh(K, M, eigvals_only=True)[6:]) / (2 * np.pi)
DIRECTIONS = np.column_stack([np.repeat(LABELS, 3), np.tile([1, 2, 3], 8)])


def grids(places=CORNERS, frames=(0,) * 8, labels=LABELS):
    return "".join(
        f"GRID,{n},,{x},{y},{z},{cd}\n" for n, (x, y, z), cd in zip(labels, places, frames, strict=True)
    )


@pytest.fixture
def read(tmp_path):
    """Reads files by their names and contents."""

    def read(**files):
        paths = []
        for name, content in files.items():
            stem, _, suffix = name.rpartition("_")
            paths.append(tmp_path / f"{stem}.{suffix}")
            paths[-1].write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_component(paths)

    return read


def check(component, expected=EXACT, rtol=1e-9, n=14):
    found = solved(component, Wanted(n_modes=n + 6)).modes.frequency_hz
    np.testing.assert_allclose(found[6:], expected[:n], rtol=rtol)


@pytest.mark.parametrize("names", [("super_pch",), ("block_bdf",), ("block_bdf", "mk_pch")])
def test_cards_are_read_in_one_pass(read, monkeypatch, names):
    """Geometry and matrices may be in one file, or each in its own."""
    began = []
    lines = bulk.cards

    def counted(path, names):
        began.append(path.name)
        return lines(path, names)

    monkeypatch.setattr(input_file, "cards", counted)
    monkeypatch.setattr(deck, "cards", counted)
    contents = [grids(), dmig("K", K, DIRECTIONS) + dmig("M", M, DIRECTIONS)]
    if len(names) == 1:
        contents = ["".join(contents)]
    check(read(**dict(zip(names, contents, strict=True))), rtol=1e-7)
    assert sorted(began) == sorted(name.replace("_", ".") for name in names)


RANDOM = np.random.default_rng(5).standard_normal((30, 30)) * (
    np.random.default_rng(6).random((30, 30)) < 0.3
)
RANDOM[:, 4] = 0


@pytest.mark.parametrize("form", ["full", "strings", "wide"])
@pytest.mark.parametrize(
    "write",
    [
        *(
            lambda A, form, o=order, w=word, s=single: op4_binary(A, form, o, w, s)
            for order in "<>"
            for word in (4, 8)
            for single in (False, True)
        ),
        *(
            lambda A, form, s=single, letter=letter: op4_text(A, form, s, letter)
            for single in (False, True)
            for letter in "ED"
        ),
    ],
)
def test_every_kind_of_output4_has_its_numbers(tmp_path, form, write):
    path = tmp_path / "some.op4"
    path.write_bytes(write({"A": RANDOM, "WIDE": RANDOM[:7], "B": RANDOM.T}, form))
    first, second = read_op4(path)
    assert (first.name, second.name) == ("A", "B")
    tolerance = 1e-6 if b"single" in path.read_bytes() else 1e-7
    np.testing.assert_allclose(first.matrix.toarray(), RANDOM, rtol=tolerance)
    np.testing.assert_allclose(second.matrix.toarray(), RANDOM.T, rtol=tolerance)


@pytest.mark.parametrize("write", [op4_binary, op4_text])
@pytest.mark.parametrize("form", ["full", "strings", "wide"])
def test_output4_in_double_precision_has_the_last_digit(tmp_path, form, write):
    path = tmp_path / "some.op4"
    path.write_bytes(write({"A": RANDOM}, form))
    np.testing.assert_array_equal(read_op4(path)[0].matrix.toarray(), RANDOM)


def g_set(A, n_scalars=0):
    """With rotations, which have nothing, and scalars behind."""
    size = 48 + n_scalars
    dofs = (6 * np.arange(8)[:, None] + np.arange(3)).ravel()
    whole = np.zeros((size, size))
    whole[np.ix_(dofs, dofs)] = A
    return whole


def test_matrices_of_all_grids_stand_in_the_order_of_the_input_file(read):
    deck = grids(CORNERS[::-1], labels=LABELS[::-1]) + f"CHEXA,1,1,{','.join(map(str, HEXA))}\n"
    component = read(block_bdf=deck, mk_op4=op4_binary({"KGG": g_set(K), "MGG": g_set(M)}))
    assert component.elements["hexa"].tolist() == [[0, 1, 3, 2, 4, 5, 7, 6]]
    check(component)


def test_scalar_points_stand_among_the_grids(read):
    """One with number 20, which comes before grids 21 to 24."""
    dofs = np.r_[0:24, 25:49]
    stiffness, mass = np.zeros((2, 49, 49))
    stiffness[np.ix_(dofs, dofs)], mass[np.ix_(dofs, dofs)] = g_set(K), g_set(M)
    mass[24, 24], mass[24, 0], mass[0, 24], stiffness[24, 24] = 1e-4, 2e-5, 2e-5, 40.0
    kept = np.flatnonzero(mass.diagonal())
    exact = scipy.linalg.eigh(stiffness[np.ix_(kept, kept)], mass[np.ix_(kept, kept)])[0]
    component = read(
        block_bdf=grids() + "SPOINT,20\n", mk_op4=op4_text({"KGG": stiffness, "MGG": mass}, "wide")
    )
    check(component, np.sqrt(exact[6:]) / (2 * np.pi))


def turned(A, axes):
    T = scipy.linalg.block_diag(*axes)
    return T.T @ A @ T


CYLINDER = "CORD2C,7,,100.,50.,0.,100.,50.,1.,200.,50.,0.\n"
"""About z through (100, 50)."""


def cylinder_axes(places):
    x, y = (places - [100, 50, 0])[:, :2].T
    about = np.arctan2(y, x)
    return [[[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]] for a in about]


def test_matrices_are_along_the_axes_of_the_grids_own_systems(read):
    axes = cylinder_axes(CORNERS)
    matrices = {"KGG": g_set(turned(K, axes)), "MGG": g_set(turned(M, axes))}
    component = read(block_bdf=CYLINDER + grids(frames=(7,) * 8), mk_op4=op4_binary(matrices))
    check(component)
    found = solved(component, Wanted(n_modes=20)).modes.shapes
    plain = read(block_bdf=grids(), mk_op4=op4_binary({"KGG": g_set(K), "MGG": g_set(M)}))
    expected = solved(plain, Wanted(n_modes=20)).modes.shapes
    np.testing.assert_allclose(abs(found), abs(expected), atol=1e-7 * abs(expected).max())


def test_elements_of_an_input_file_with_matrices_are_drawn_and_that_is_told(read):
    deck = grids() + f"CHEXA,1,1,{','.join(map(str, HEXA))}\n"
    component = read(block_bdf=deck + dmig("K2GG", K, DIRECTIONS) + dmig("M2GG", M, DIRECTIONS))
    assert len(component.elements["hexa"]) == 1
    assert any("only drawn" in note for note in component.notes)


@pytest.mark.parametrize("form", [1, 6])
def test_matrices_are_cards_of_an_input_file(read, form):
    cards = dmig("K2GG", K, DIRECTIONS, form) + dmig("M2GG", M, DIRECTIONS, form)
    check(read(block_bdf=grids() + cards), rtol=1e-7)


def test_matrices_are_punched_and_the_grids_in_an_input_file(read):
    cards = dmig("KAAX", K, DIRECTIONS) + dmig("MAAX", M, DIRECTIONS)
    check(read(block_bdf=grids(), mk_pch=cards), rtol=1e-7)


def external(labels=LABELS):
    listed = [f"{n:8d}{123:8d}" for n in labels]
    return "\n".join(["EXTRN   " + "".join(listed[:4]), "        " + "".join(listed[4:]), ""])


def test_a_punched_superelement_has_its_boundary_grids(read):
    """As EXTSEOUT(DMIGPCH) writes it: geometry and matrices in one file."""
    cards = dmig("KAAX", K, DIRECTIONS) + dmig("MAAX", M, DIRECTIONS)
    component = read(super_pch="BEGIN SUPER      101\n" + external() + grids() + cards)
    check(component, rtol=1e-7)


def test_a_superelement_in_output4_has_the_order_of_its_cards(read):
    """As EXTSEOUT(MATOP4) writes it; the inner coordinates are scalars, a grid's system is its own."""
    axes = cylinder_axes(CORNERS)
    Q = np.linalg.qr(np.random.default_rng(2).standard_normal((24, 24)))[0]
    inner = scipy.linalg.block_diag(turned(K, axes), np.diag([50.0, 90.0]))
    mass = scipy.linalg.block_diag(turned(M, axes), np.eye(2) * 1e-4)
    mass[24:, :24] = 1e-4 * Q[:2]
    mass[:24, 24:] = mass[24:, :24].T
    exact = np.sqrt(scipy.linalg.eigh(inner, mass, eigvals_only=True)[6:]) / (2 * np.pi)
    cards = (
        CYLINDER
        + external()
        + "EXTRN       9001       0    9002       0\n"
        + grids(frames=(7,) * 8)
        + "SPOINT      9001    9002\n"
    )
    component = read(super_pch=cards, super_op4=op4_binary({"KXX": inner, "MXX": mass}, "strings"))
    check(component, exact)


def test_an_order_that_lists_a_direction_twice_is_refused(read):
    cards = external([*LABELS[:7], LABELS[6]]) + grids()
    with pytest.raises(VehicleError, match=rf"node {LABELS[6]}, direction 1: is there twice"):
        read(super_pch=cards, super_op4=op4_binary({"KXX": K, "MXX": M}))


def test_grids_that_the_matrices_do_not_move_are_left_out_and_told(read):
    deck = grids() + "GRID,900,,1.,2.,3.\nCBAR,1,1,11,900\n"
    cards = dmig("K2GG", K, DIRECTIONS) + dmig("M2GG", M, DIRECTIONS)
    component = read(block_bdf=deck + cards)
    assert component.node_ids.tolist() == LABELS.tolist()
    assert "1 nodes are none of the matrices' and are left out" in component.notes
    assert not component.elements


GOOD = op4_binary({"KGG": g_set(K), "MGG": g_set(M)}, "strings")
TEXT = op4_text({"KGG": g_set(K), "MGG": g_set(M)}, "strings")


def at(place, new, content=GOOD):
    return content[:place] + new + content[place + len(new) :]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is no OUTPUT4 file"),
        (b"\0" * 100, "is no OUTPUT4 file"),
        (b"PK" + GOOD, "is no OUTPUT4 file"),
        (GOOD[: len(GOOD) // 3], "the file is cut"),
        (GOOD[:20], "the file is cut"),
        (GOOD.replace(b"\n", b"\r\n"), "damaged|cut|shorter|other lengths"),
        (at(4, (2**30).to_bytes(4, "little")), "columns or rows of a matrix"),
        (at(16, b"\x09"), "type 9"),
        (at(32, b"\x01"), "other lengths at its ends"),
        (at(36, b"\xff\xff"), "found column|cut|shorter|string of|of type"),
        (at(44, b"\xff\xff\xff\x7f"), "shorter than it says|string of"),
        (TEXT[: len(TEXT) // 3], "the file is cut|no numbers|string of"),
        (TEXT.replace(b"E+0", b"E+x", 1), "found no numbers"),
        (TEXT.replace(b"1P,3E23.16", b"1P,zzzzzzz", 1), "expected a format"),
        (TEXT.replace(b"      48      48", b"      48       z", 1), "expected a whole number|OUTPUT4"),
        (op4_text({"KGG": g_set(K) * np.nan, "MGG": g_set(M)}), "not finite numbers"),
        (op4_binary({"KGG": g_set(K)[:, :47], "MGG": g_set(M)}), "no stiffness matrix"),
        (op4_binary({"KGG": g_set(K)[:47, :47], "MGG": g_set(M)}), "48 rows, matrix KGG 47"),
    ],
)
def test_damaged_output4_files_are_refused_in_a_sentence(read, content, words):
    with pytest.raises(VehicleError, match=words):
        read(block_bdf=grids(), mk_op4=content)


CARDS = dmig("KAAX", K, DIRECTIONS) + dmig("MAAX", M, DIRECTIONS)


@pytest.mark.parametrize(
    ("cards", "words"),
    [
        (CARDS + dmig("KAAX", K, DIRECTIONS), "'KAAX': begins twice"),
        (CARDS[CARDS.index("DMIG*") :], "before the card that says what it is"),
        (CARDS.replace("11               1", "11               9", 1), "grid 11, direction 9"),
        (CARDS[: CARDS.index("DMIG    MAAX")], "no mass matrix"),
        (CARDS.replace("D+0", "Q+0", 1), "expected a number"),
        (CARDS.replace("              11               1", "            7711               1"), "7711"),
    ],
)
def test_wrong_cards_are_refused_in_a_sentence(read, cards, words):
    with pytest.raises(VehicleError, match=words):
        read(block_bdf=grids(), mk_pch=cards)
