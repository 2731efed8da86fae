"""Messages stay sentences, however much the user gave."""

import pickle
import zipfile
from pathlib import Path

import numpy as np
import pytest
from folders import one_of_everything
from mounted_cabin import mounted_cabin
from shaken_blocks import bolted_apart
from small_systems import block

from modeviz.cli import main
from modeviz.errors import (
    LONGEST,
    ModevizError,
    PartError,
    SolveError,
    VehicleError,
    cut,
    listed,
    located,
    of_file,
    of_part,
    paths_together,
    quoted,
    reason,
    unknown,
)
from modeviz.files import write_vehicle
from modeviz.files.schema.decoding import decode
from modeviz.units import parse
from modeviz.vehicle.arrays import frozen
from modeviz.vehicle.bodies import Material, MeshPart
from modeviz.vehicle.connections import GROUND, MOTIONS, Bolt, Spring
from modeviz.vehicle.vehicle import Vehicle

MANY = [f"name {i}" for i in range(100_000)]
LONG = "x" * 1_000_000


def test_what_is_long_is_cut_in_its_midst():
    assert cut("short", 9) == "short"
    assert cut("abcdefghijkl", 9) == "abcde…jkl"
    assert len(cut(LONG, 80)) == 80


def test_of_long_names_so_many_are_listed_as_make_a_sentence():
    text = listed(["x" * 200] * 20)
    assert text == ", ".join([text.split(", ")[0]] * 10) + ", 10 more"


def test_of_many_names_the_first_are_listed_and_the_others_counted():
    assert listed(["a", "b"]) == "a, b"
    assert listed([]) == "none"
    text = listed(MANY)
    assert text.startswith("name 0, name 1, ")
    assert text.endswith(", name 29, 99970 more")


def test_a_likely_name_is_found_among_many():
    text = unknown("attachment", "nam 4999", MANY[:5000])
    assert "did you mean 'name 4999'?" in text
    assert len(text) < 1000
    assert len(unknown("attachment", "nam 4999", MANY)) < 1000
    assert len(unknown("attachment", LONG, MANY)) < 1000


@pytest.mark.parametrize(("value", "length"), [("a", 3), (LONG, 82), (np.zeros(10**5), 80)])
def test_what_is_quoted_has_its_beginning_and_its_end(value, length):
    assert len(quoted(value)) <= length


def test_no_message_is_longer_than_a_paragraph():
    with pytest.raises(VehicleError) as caught, located(LONG), located("truck/vehicle.toml"):
        raise ModevizError(f"found {LONG}, expected a number")
    text = str(caught.value)
    assert len(text) == LONGEST
    assert text.startswith("xxx")
    assert text.endswith("expected a number")


def held_altogether():
    """A block bolted rigidly to the ground."""
    bolt = Bolt("bolt", "bolts", ("a", GROUND), np.zeros((2, 3)), rigid=MOTIONS)
    return Vehicle("held", (block("a"),), (bolt,))


def held_like_rock():
    """A block on a spring that drowns slow modes in rounding."""
    spring = Spring("rock", "springs", ("a", GROUND), np.zeros((2, 3)), np.array([1e15, 0.0, 0.0]))
    return Vehicle("rock", (block("a", 1.0),), (spring,))


@pytest.mark.parametrize(
    ("vehicle", "command", "words"),
    [
        (held_altogether, "modes", "the rigid connections hold everything"),
        (held_like_rock, "modes", "the slow modes drown in rounding: 'a x'"),
        (bolted_apart, "wheels", "base motion 'shaker': '"),
    ],
)
def test_what_a_folder_makes_impossible_is_said_with_its_file(
    capsys, tmp_path, vehicle, command, words
):
    write_vehicle(vehicle(), tmp_path / "v")
    assert main([command, str(tmp_path / "v")]) == 2
    *_notes, said = capsys.readouterr().err.splitlines()
    assert said.startswith(f"modeviz: {tmp_path / 'v' / 'vehicle.toml'}: {words}")


def test_an_error_keeps_its_kind_and_has_its_file_if_there_is_one():
    with (
        pytest.raises(SolveError, match=r"^truck/vehicle\.toml: no modes$"),
        of_file("truck/vehicle.toml"),
    ):
        raise SolveError("no modes")
    with pytest.raises(SolveError, match=r"^no modes$"), of_file(""):
        raise SolveError("no modes")


def test_an_error_comes_back_from_another_process():
    error = pickle.loads(pickle.dumps(VehicleError("body 'a': mass: found 0")))
    assert (type(error), str(error)) == (VehicleError, "body 'a': mass: found 0")


class Owner:
    name = "a"


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: frozen(Owner(), "positions", MANY, (None,)),
        lambda: parse(LONG, "stiffness"),
        lambda: decode({"a": LONG}, dict[str, float]),
        lambda: decode({LONG: "b"}, dict[str, float]),
        lambda: decode({"a": [[0.0] * 10**5]}, dict[str, float]),
        lambda: mounted_cabin().with_rates({LONG: mounted_cabin().rates["A"]}),
    ],
)
def test_whatever_is_wrong_is_said_in_few_words(wrong):
    with pytest.raises(ModevizError) as caught:
        wrong()
    assert 10 < len(str(caught.value)) <= LONGEST


def test_an_archive_of_many_arrays_is_not_listed_whole(capsys, tmp_path):
    write_vehicle(one_of_everything(), tmp_path / "truck")
    (path,) = (tmp_path / "truck/bodies").iterdir()
    with zipfile.ZipFile(path, "w") as archive:
        for name in MANY[:5000]:
            archive.writestr(f"{name}.npy", b"")
    assert main(["modes", str(tmp_path / "truck")]) == 2
    error = capsys.readouterr().err
    assert len(error) < 1000
    assert "4970 more" in error


def test_a_folder_of_a_long_name_is_a_short_sentence(capsys, tmp_path):
    write_vehicle(mounted_cabin(), tmp_path / "cabin")
    toml = Path(tmp_path / "cabin/vehicle.toml")
    toml.write_text(toml.read_text().replace('name = "cab"', f'name = "cab"\n{LONG} = 1', 1))
    assert main(["modes", str(tmp_path / "cabin")]) == 2
    error = capsys.readouterr().err
    assert len(error) < LONGEST + 100
    assert "unknown key" in error


def test_a_reason_is_never_empty():
    assert reason(MemoryError()) == "MemoryError"
    assert reason(OSError(28, "No space left on device")) == "No space left on device"
    assert reason(ValueError("bad magic")) == "bad magic"


def test_a_reason_is_one_line_and_not_long():
    assert len(reason(ValueError("x" * 900))) == 200
    assert reason(ValueError("no workbook.\nSee the exception for more.")) == "no workbook."
    assert reason(ValueError("\n")) == "ValueError"


@pytest.mark.parametrize(
    ("where", "text", "expected"),
    [
        ("a.bdf", "is cut", "a.bdf: is cut"),
        ("a.bdf", "a.bdf: is cut", "a.bdf: is cut"),
        ("a.bdf", "there/a.bdf: is cut", "there/a.bdf: is cut"),
        ("there/a.bdf", "a.bdf: is cut", "there/a.bdf: is cut"),
        ("there/a.bdf", "a.bdf: line 3: is cut", "there/a.bdf: line 3: is cut"),
        ("there/a.bdf", "f: is cut", "there/a.bdf: f: is cut"),
        ("a.bdf, there/b.op2", "b.op2: is cut", "there/b.op2: is cut"),
        ("a.bdf, b.op2", "are of two models", "a.bdf, b.op2: are of two models"),
        ("--residual", "a.csv: a.csv", "--residual: a.csv: a.csv"),
        ("a.csv", "a.csv", "a.csv: a.csv"),
    ],
)
def test_a_place_is_said_once(where, text, expected):
    with pytest.raises(VehicleError) as error, located(where):
        raise ModevizError(text)
    assert str(error.value) == expected
    with pytest.raises(SolveError) as error, of_file(where):
        raise SolveError(text)
    assert str(error.value) == expected


def test_files_beside_each_other_have_their_folder_said_once():
    block, other = Path("/models/block"), Path("/models/other")
    files = [block / "M.mtx", block / "K.mtx", other / "nodes.csv", other / "faces.stl"]
    said = paths_together(files)
    assert said == f"{files[0]}, K.mtx, {files[2]}, faces.stl"
    with pytest.raises(VehicleError) as caught, located(said):
        raise VehicleError(f"{files[1]}: has no rows")
    assert str(caught.value) == f"{files[1]}: has no rows"


@pytest.mark.parametrize("values", [[[0.0, np.nan, 0.0]], [[0.0, 0.0]]])
def test_a_kind_is_said_in_words_not_as_a_class(values):
    with pytest.raises(VehicleError, match=r"^mesh part 'bonnet': vertices: found"):
        MeshPart("bonnet", np.array(values), np.array([[0, 0, 0]]), Material((0, 0, 0)))


def test_a_part_is_said_once():
    with pytest.raises(PartError) as error, of_part("body", "cab"), of_part("body", "cab"):
        raise VehicleError("is too heavy")
    assert str(error.value) == "body 'cab': is too heavy"
