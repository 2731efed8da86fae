"""The tables of `vehicle.toml` that say what presses on a vehicle that stands still, in SI."""

from typing import Self

import msgspec
import numpy as np

from modeviz.files.records.fields import ForceVector, LoadInG, Name, Position, TorqueVector
from modeviz.files.records.record import Record, built, said, tuples
from modeviz.vehicle.load_cases import WEIGHT, LoadCase, StaticLoad

NONE = (0.0, 0.0, 0.0)


class StaticLoadRecord(Record, kw_only=True):
    """[[load_case.load]]."""

    body: str
    force: ForceVector = NONE
    torque: TorqueVector = NONE
    at: Position | None = None
    """Where the force acts; at the body's centre of gravity, if not given."""

    @classmethod
    def of(cls, load: StaticLoad) -> Self:
        fields = {"force": load.force, "torque": load.torque, "at": load.position}
        return cls(body=load.body, **said(cls, {key: tuples(value) for key, value in fields.items()}))

    def build(self) -> StaticLoad:
        at = None if self.at is None else np.array(self.at)
        return StaticLoad(self.body, np.array(self.force), np.array(self.torque), at)


class LoadCaseRecord(Record, kw_only=True):
    """[[load_case]]."""

    name: Name
    load_g: LoadInG = WEIGHT
    """What all mass weighs, in g."""
    load: list[StaticLoadRecord] = msgspec.field(default_factory=list)

    @classmethod
    def of(cls, case: LoadCase) -> Self:
        loads = [StaticLoadRecord.of(load) for load in case.loads]
        return cls(name=case.name, load=loads, **said(cls, {"load_g": tuples(case.load_g)}))

    def build(self) -> LoadCase:
        loads = built(self.load, "load", StaticLoadRecord.build)
        return LoadCase(self.name, np.array(self.load_g), loads)
