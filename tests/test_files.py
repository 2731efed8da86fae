"""The vehicle folder: what is written comes back, and what is wrong in it is said."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from folders import one_of_everything

from modeviz.errors import VehicleError
from modeviz.vehicle.files import read_vehicle, write_vehicle


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_vehicle(one_of_everything(), tmp_path / "truck")
    return tmp_path / "truck"


def edit(folder: Path, old: str, new: str) -> None:
    """Changes the first `old` of vehicle.toml."""
    path = folder / "vehicle.toml"
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def complaint(folder: Path) -> str:
    with pytest.raises(VehicleError) as caught:
        read_vehicle(folder)
    return str(caught.value)


def content(folder: Path) -> dict[str, bytes]:
    return {
        str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()
    }


def assert_same(found, expected) -> None:
    """Equal to the last bit, dataclasses field by field."""
    assert type(found) is type(expected)
    if dataclasses.is_dataclass(expected):
        for field in dataclasses.fields(expected):
            assert_same(getattr(found, field.name), getattr(expected, field.name))
    elif isinstance(expected, tuple):
        assert len(found) == len(expected)
        for pair in zip(found, expected, strict=True):
            assert_same(*pair)
    elif isinstance(expected, dict):
        assert list(found) == list(expected)
        for key in expected:
            assert_same(found[key], expected[key])
    elif isinstance(expected, np.ndarray):
        assert found.dtype == expected.dtype
        np.testing.assert_array_equal(found, expected)
    else:
        assert found == expected


def test_vehicle_comes_back_to_the_last_bit(folder):
    assert_same(read_vehicle(folder), one_of_everything())
