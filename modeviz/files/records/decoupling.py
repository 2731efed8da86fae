"""The table of `vehicle.toml` on what rigid modes are held against."""

from typing import Annotated, Self

from msgspec import Meta

from modeviz.files.records.fields import Frequency, LowestFrequency
from modeviz.files.records.record import Record
from modeviz.files.schema.quantities import UNITLESS
from modeviz.files.toml_writer import toml_value
from modeviz.vehicle.decoupling import USUAL, Decoupling


class DecouplingRecord(Record, kw_only=True):
    """[decoupling]."""

    purity: Annotated[float, Meta(gt=0, le=1), UNITLESS] = USUAL.purity
    lowest_frequency: LowestFrequency = USUAL.lowest_frequency
    highest_frequency: Frequency = USUAL.highest_frequency
    gap: LowestFrequency = USUAL.gap
    bounce_gap: LowestFrequency = USUAL.bounce_gap

    @classmethod
    def of(cls, decoupling: Decoupling) -> Self | None:
        """None for what is usual."""
        if decoupling == USUAL:
            return None
        return cls(**{key: getattr(decoupling, key) for key in cls.__struct_fields__})

    def build(self) -> Decoupling:
        return Decoupling(**{key: getattr(self, key) for key in self.__struct_fields__})


def decoupling_text(decoupling: Decoupling) -> str:
    """The table of some targets, every key of it, to be put into a vehicle.toml."""
    keys = DecouplingRecord.__struct_fields__
    lines = (f"{key} = {toml_value(getattr(decoupling, key))}" for key in keys)
    return "\n".join(["[decoupling]", *lines, ""])
