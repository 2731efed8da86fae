"""TOML files in declared units as records in SI."""

import tomllib
from pathlib import Path
from typing import TypeVar

import msgspec

from modeviz.errors import VehicleError, located
from modeviz.vehicle.files.decoding import decode
from modeviz.vehicle.files.disk import read_text
from modeviz.vehicle.files.record import FileRecord
from modeviz.vehicle.files.scaling import to_si

R = TypeVar("R", bound=FileRecord)


def read_toml(path: Path, kind: type[R]) -> R:
    """A file's content, in SI.

    Raises:
        VehicleError: the file is missing, not TOML, or not of that kind; the text names it and the key.
    """
    try:
        data = tomllib.loads(read_text(path))
    except (ValueError, RecursionError) as error:
        raise VehicleError(f"{path}: not TOML: {error}") from None
    with located(path):
        record = decode(data, kind)  # before scaling, so that errors show the file's own numbers
        return msgspec.convert(to_si(data, kind, record.units), kind)
