"""The line of a key is found as an editor numbers it."""

import pytest

from modeviz.files.key_lines import key_lines, line_of

TEXT = """name = "x" # [[no.table]]
[units]
length = "m"

[[spring]]
name = "a"
[[ spring ]]  # the second
name = "b"
stiffness = [
  1.0,
]
[[mount_group]]
[[mount_group.mount]]
at = 1
[[mount_group]]
[[mount_group.mount]]
[[mount_group.mount]]
"at" = 2
[rates."as new"]
C1 = { vertical = 1.0 }
"""


@pytest.mark.parametrize(
    ("path", "line"),
    {
        "name": 1,
        "units.length": 3,
        "units.mass": 2,
        "spring[0]": 5,
        "spring[1].name": 8,
        "spring[1].stiffness[0]": 9,
        "mount_group[0].mount[0].at": 14,
        "mount_group[1].mount[0].at": 16,
        "mount_group[1].mount[1].at": 18,
        "mount_group[1].rates": 15,
        "rates.as new.C1.vertical": 20,
        "damper[0]": 0,
        "": 0,
    }.items(),
)
def test_a_key_is_in_its_line_and_one_that_is_missing_in_that_of_its_table(path, line):
    assert line_of(path, list(key_lines(TEXT))) == line
