"""What only follows from a fault that is told is no problem of its own."""

import pytest
from test_tuned_parts import FILE, GROUPS, folder

from modeviz.files.new_vehicle import new_vehicle
from modeviz.files.survey import survey


def words_of(path):
    return [problem.words for problem in survey(path).problems]


@pytest.fixture
def cab(tmp_path):
    return new_vehicle("cab", tmp_path / "cab")


def altered(path, old, new):
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new), "utf-8")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (",200,150,35,", ",-200,150,35,", "line 2, column k_x [N/mm]: found -200"),
        ("400,6400", "7400,6400", "line 2, column stiffest_c_z [N s/m]: found 6400"),
    ],
)
def test_of_a_refused_row_those_that_have_its_rates_are_not_told(cab, old, new, words):
    altered(cab / "mounts.csv", old, new)
    (found,) = words_of(cab)
    assert words in found


def test_a_row_of_a_refused_group_is_told_what_is_wrong_of_its_own(cab):
    altered(cab / "mounts.csv", ",200,150,35,", ",-200,150,35,")
    altered(cab / "mounts.csv", "front right,F,cab", "front right,F,cabin")
    first, second = words_of(cab)
    assert "line 2" in first
    assert "line 3, column body_1: unknown body 'cabin'" in second


def test_a_group_whose_damper_is_wrong_is_not_told_besides(tmp_path):
    file = FILE.replace("at = [0.9, 0, 0.9]\nstiffness", 'at = [0.9, "x", 0.9]\nstiffness')
    assert [p.key for p in survey(folder(tmp_path / "v", GROUPS, file)).problems] == ["spring[0].at[1]"]


def test_nor_one_of_a_table_of_mounts_that_is_wrong(tmp_path):
    path = folder(tmp_path / "v", GROUPS)
    altered(path / "mounts.csv", "rubber 1,cab", "rubber 1,cob")
    (found,) = words_of(path)
    assert "line 2" in found
