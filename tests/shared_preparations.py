"""One preparation for all commands that look at the same folder: those of a file of tests, mostly."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from modeviz.analysis.preparation import Prepared, prepare
from modeviz.cli import options
from modeviz.vehicle.vehicle import Vehicle


@contextmanager
def shared_preparations() -> Iterator[None]:
    """What commands prepare inside is kept, by folder; none of the folders may be changed."""
    known: dict[str, Prepared] = {}

    def prepare_once(vehicle: Vehicle, **tell) -> Prepared:
        if vehicle.file not in known:
            known[vehicle.file] = prepare(vehicle, **tell)
        return known[vehicle.file]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(options, "prepare", prepare_once)
        yield
