"""docs/import.md says what the readers take."""

import re
from pathlib import Path

import pytest

from modeviz.files.meshes import READERS as MESHES
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.formats.matrices import SUFFIXES as MATRICES
from modeviz.formats.reading import READERS
from modeviz.units import UNITS

PAGE = Path(__file__).parents[2].joinpath("docs/import.md").read_text("utf-8")


def test_the_page_has_every_system_of_units_with_what_it_is():
    rows = re.findall(r"(?m)^\| `(\S+)` \| (.+?) \| (.+?) \| (.+?) \|$", PAGE)
    forces = {"N": 1.0, "mN": 1e-3, "lbf": UNITS["force"]["lbf"]}
    assert {name for name, *_ in rows} == set(UNIT_SYSTEMS)
    for name, length, mass, force in rows:
        system = UNIT_SYSTEMS[name]
        assert system.length == UNITS["length"][length]
        assert system.mass == UNITS["mass"][mass]
        assert system.mass * system.length == pytest.approx(forces[force])


def test_the_page_names_endings_of_every_format():
    named = set(re.findall(r"`(\.\w+)`", PAGE))
    assert named <= {*READERS, *MATRICES, *MESHES}
    assert {READERS[ending] for ending in named & set(READERS)} == set(READERS.values())
    assert set(MATRICES) | set(MESHES) <= named
