"""Every number of a file says what it is: in a unit of the file, in a fixed one, or in none."""

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, Literal, get_args

import msgspec
import numpy as np
import pytest
from folders import one_of_everything

from modeviz.errors import VehicleError
from modeviz.files import write_vehicle
from modeviz.files.problem_file import ProblemFileRecord
from modeviz.files.rate_files import RatesFile, parse_rates, rates_text
from modeviz.files.records.record import Record
from modeviz.files.records.vehicle import VehicleRecord
from modeviz.files.schema.axes import Turns, turn_vectors
from modeviz.files.schema.hints import fields_of, is_record
from modeviz.files.schema.quantities import UNITLESS, FixedUnit, Quantity, Vector
from modeviz.files.schema.scaling import from_si, to_si
from modeviz.units import UNITS, WRITTEN_UNITS, QuantityName

ROOTS = [VehicleRecord, ProblemFileRecord, RatesFile]


def numbers_of(hint: Any, notes: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The annotations over each place of a hint where a number can stand, records in it left out."""
    if hint in (int, float):
        yield notes
    own = getattr(hint, "__metadata__", ())
    inner = (hint.__origin__,) if own else get_args(hint)
    for kind in inner:
        yield from numbers_of(kind, (*notes, *own))


def records(hint: Any) -> Iterator[type]:
    if is_record(hint):
        yield hint
        for inner in fields_of(hint).values():
            yield from records(inner)
    for inner in get_args(hint):
        yield from records(inner)


RECORDS = sorted({r for root in ROOTS for r in records(root)}, key=lambda r: r.__name__)


@pytest.mark.parametrize("record", RECORDS)
def test_every_number_of_every_record_says_what_it_is(record):
    assert issubclass(record, Record)
    for key, hint in fields_of(record).items():
        for notes in numbers_of(hint):
            said = [note for note in notes if isinstance(note, Quantity | FixedUnit)]
            assert len(said) == 1, key


def test_records_have_numbers_of_every_quantity():
    """So that the test above looks at something; and there is one list of quantities."""
    notes = [n for r in RECORDS for hint in fields_of(r).values() for n in numbers_of(hint)]
    found = {name for each in notes for n in each if isinstance(n, Quantity) for name in n.names}
    assert found == set(UNITS) == set(get_args(QuantityName)) == set(WRITTEN_UNITS)
    assert all(unit in UNITS[quantity] for quantity, unit in WRITTEN_UNITS.items())


@pytest.mark.parametrize(
    "hint",
    [
        float,
        int,
        float | None,
        tuple[float, ...],
        dict[str, float],
        Literal["none"] | tuple[float, float],
        Annotated[float, msgspec.Meta(ge=0)],
        Annotated[float, UNITLESS] | list[int],
    ],
)
def test_a_record_with_a_number_of_which_nothing_is_said_cannot_be_made(hint):
    with pytest.raises(TypeError, match=r"^R\.size: numbers without a Quantity or a FixedUnit$"):
        type("R", (Record,), {"__annotations__": {"size": hint}})


def test_a_record_with_a_vector_that_does_not_say_how_it_turns_cannot_be_made():
    hint = Annotated[Vector, Quantity("length")]
    with pytest.raises(TypeError, match=r"^R\.place: vectors that do not say how they turn$"):
        type("R", (Record,), {"__annotations__": {"place": hint}})
    turning = Annotated[Vector, Quantity("length"), Turns(turn_vectors)]
    assert type("R", (Record,), {"__annotations__": {"place": turning, "yes": bool, "name": str}})


class Sized(Record):
    size: Annotated[float, Quantity("length")]


class Either(Record):
    by: Annotated[tuple[float, ...], UNITLESS] | Sized | None


def test_a_table_that_may_be_a_list_too_has_the_quantities_of_its_own():
    assert to_si({"by": {"size": 2.0}}, Either, {"length": "mm"}) == {"by": {"size": 2e-3}}
    assert to_si({"by": [2.0]}, Either, {"length": "mm"}) == {"by": [2.0]}


def test_a_text_with_a_quantity_is_not_scaled():
    """It names a file, which may say its own unit."""
    data = {"name": "f", "body": "b", "at": [1, 2, 3], "direction": "vertical", "psd": "1"}
    found = to_si({"force": [data]}, VehicleRecord, {"length": "mm"})["force"][0]
    assert found["psd"] == "1"
    np.testing.assert_allclose(found["at"], [1e-3, 2e-3, 3e-3], rtol=1e-15)


def test_a_quantity_that_depends_on_the_kind_has_the_unit_of_its_own():
    loads = [{"kind": kind, "amplitude": 2} for kind in ("unbalance", "radial force", "lateral force")]
    units = {"unbalance": "g m", "force": "kN"}
    found = to_si({"wheel_load": loads}, VehicleRecord, units)["wheel_load"]
    assert [load["amplitude"] for load in found] == pytest.approx([2e-3, 2e3, 2e3], rel=1e-15)


OTHER_UNITS: Mapping[QuantityName, str] = {
    "length": "in",
    "mass": "slug",
    "inertia": "lbf in s²",
    "stiffness": "lbf/in",
    "rotational_stiffness": "lbf in/rad",
    "damping": "lbf s/in",
    "rotational_damping": "N m s/deg",
    "force": "lbf",
    "torque": "lbf ft",
    "acceleration": "g",
    "unbalance": "oz in",
    "speed": "mph",
}


def scalars(data: Any) -> Iterator[Any]:
    if isinstance(data, dict | list):
        for inner in data.values() if isinstance(data, dict) else data:
            yield from scalars(inner)
    else:
        yield data


def test_what_is_written_in_any_units_reads_back(tmp_path: Path):
    """Writing is the inverse of reading by the same annotations, to the last bit."""
    write_vehicle(one_of_everything(), tmp_path / "a")
    own = tomllib.loads((tmp_path / "a/vehicle.toml").read_text("utf-8"))
    in_si = to_si(own, VehicleRecord, own["units"])
    written = from_si(in_si, VehicleRecord, OTHER_UNITS)
    n_changed = sum(a != b for a, b in zip(scalars(written), scalars(in_si), strict=True))
    assert n_changed > 50
    back = to_si(written, VehicleRecord, OTHER_UNITS)
    for found, expected in zip(scalars(back), scalars(in_si), strict=True):
        assert found == (pytest.approx(expected, rel=4e-16) if isinstance(found, float) else expected)


@pytest.mark.parametrize("file_format", ["csv", "json"])
def test_files_of_rates_have_the_quantities_of_their_record(file_format):
    vehicle = one_of_everything()
    rates = {"C1": replace(vehicle.mount_groups[0].rates, loss_factor=0.3)}
    text = rates_text(rates, file_format).replace("N/mm", "lbf/in")
    (found,) = parse_rates(text, file_format, vehicle).values()
    ratio = UNITS["stiffness"]["lbf/in"] / UNITS["stiffness"]["N/mm"]
    np.testing.assert_allclose(found.as_tuple(), np.multiply(rates["C1"].as_tuple(), ratio), rtol=1e-15)
    assert found.loss_factor == 0.3


def test_rates_that_no_vehicle_has_are_refused_in_json_as_in_a_vehicle():
    rates = '{"units": "N/mm", "rates": {"C1": {"vertical": 1e40, "lateral": 1, "fore_aft": 1}}}'
    words = r"rates\.C1\.vertical: found 1e\+40 N/mm, expected up to 1e\+12"
    with pytest.raises(VehicleError, match=words):
        parse_rates(rates, "json", one_of_everything())
