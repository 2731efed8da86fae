"""What does not fit a record is said by its place and its type, whatever words msgspec has for it."""

import math
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

import msgspec
import pytest
from folders import one_of_everything
from msgspec import Meta, Struct

from modeviz.errors import VehicleError
from modeviz.files import write_vehicle
from modeviz.files.records.vehicle import VehicleRecord
from modeviz.files.schema.decoding import decode

WRONG = ["hard", True, -1, math.nan, [True], {"a": 1}]


class Inner(Struct, forbid_unknown_fields=True):
    size: Annotated[int, Meta(ge=2, le=9)]
    ratio: Annotated[float, Meta(gt=0, lt=1)] | None = None


class Outer(Struct, forbid_unknown_fields=True, rename="camel"):
    by_name: dict[str, Inner] = msgspec.field(default_factory=dict)
    pair: tuple[float, str] = (0.0, "")
    some: Annotated[tuple[float, ...], Meta(min_length=2, max_length=3)] | float = 0.0
    kind: Literal["left", "right"] = "left"
    limit: tuple[float, float] | Literal["none"] | None = None
    steps: Inner | list[int] | None = None
    label: Annotated[str, Meta(min_length=1)] = "x"


class Open(Struct):
    """Keys that it does not know are left alone."""

    size: int = 0


SENTENCES = {
    "a table": (3, "found 3, expected a table"),
    "a key of a dictionary": ({"byName": {"a.b": {"size": "x"}}}, "byName.a.b.size: found 'x', expe"),
    "missing": ({"byName": {"a": {}}}, "byName.a.size: missing"),
    "unknown": ({"by_name": {}}, "by_name: unknown key 'by_name': did you mean 'byName'? there are by"),
    "least": ({"steps": {"size": 1}}, "steps.size: found 1, expected a whole number at least 2"),
    "most": ({"steps": {"size": 10}}, "steps.size: found 10, expected a whole number at most 9"),
    "above": ({"steps": {"size": 2, "ratio": 0}}, "ratio: found 0, expected a number above zero"),
    "below": ({"steps": {"size": 2, "ratio": 1}}, "ratio: found 1, expected a number below 1"),
    "truth for a number": (
        {"steps": {"size": True}},
        "steps.size: found True, expected a whole number",
    ),
    "an item of a union": ({"steps": [1, "x"]}, "steps[1]: found 'x', expected a whole number"),
    "none of a union": ({"steps": "x"}, "steps: found 'x', expected a table or a list"),
    "one item too few": ({"pair": [1]}, "pair: found [1], expected a list of length 2"),
    "the second of a pair": ({"pair": [1, 2]}, "pair[1]: found 2, expected text"),
    "short": ({"some": [1]}, "some: found [1], expected a list of length at least 2"),
    "long": ({"some": [1] * 4}, "some: found [1, 1, 1, 1], expected a list of length at most 3"),
    "no value of those": (
        {"kind": "lefd"},
        "unknown value 'lefd': did you mean 'left'? there are left",
    ),
    "a number for a choice": ({"kind": 3}, "kind: found 3, expected 'left' or 'right'"),
    "the only word": ({"limit": "no"}, "limit: found 'no', expected a list or 'none'"),
    "empty text": ({"label": ""}, "label: found '', expected text of length at least 1"),
    "lists within lists": (
        {"label": [[[[9] * 9] * 9] * 9] * 9},
        "...], … 9, ...], ...], ...], ...], expected text",
    ),
    "the whole is infinite": (math.inf, "found inf, expected a finite number below 1e+100"),
}


@pytest.fixture
def speechless(monkeypatch: pytest.MonkeyPatch) -> None:
    """msgspec refuses what it does, and says nothing."""
    convert = msgspec.convert

    def silent(*arguments: Any) -> Any:
        try:
            return convert(*arguments)
        except msgspec.ValidationError:
            raise msgspec.ValidationError from None

    monkeypatch.setattr(msgspec, "convert", silent)


@pytest.mark.usefixtures("speechless")
@pytest.mark.parametrize("case", SENTENCES)
def test_the_sentence_comes_from_types_and_not_from_the_words_of_msgspec(case):
    data, words = SENTENCES[case]
    with pytest.raises(VehicleError) as caught:
        decode(data, Outer)
    assert words in str(caught.value)


def test_a_table_that_leaves_other_keys_alone_is_told_its_wrong_one():
    assert decode({"other": "x"}, Open).size == 0
    with pytest.raises(VehicleError, match=r"^at\.size: found 'x'"):
        decode({"other": 1, "size": "x"}, Open, "at")


@pytest.mark.parametrize("place", [0, 1, 999, 1000, 99_999])
def test_the_wrong_item_of_very_many_is_found_without_asking_for_each(monkeypatch, place):
    items: list[Any] = [2] * 100_000
    items[place] = "x"
    asked = []
    convert = msgspec.convert
    monkeypatch.setattr(msgspec, "convert", lambda *all_: asked.append(0) or convert(*all_))
    with pytest.raises(VehicleError, match=rf"^steps\[{place}\]: found 'x', expected a whole"):
        decode({"steps": items}, Outer)
    assert len(asked) < 2000


def changed(data: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """The data with one value replaced by one of `WRONG`, and its key path: each by each."""
    yield from ((path, wrong) for wrong in WRONG)
    if isinstance(data, dict):
        for key, value in data.items():
            for where, new in changed(value, f"{path}.{key}".lstrip(".")):
                yield where, {**data, key: new}
    elif isinstance(data, list):
        for index, value in enumerate(data):
            for where, new in changed(value, f"{path}[{index}]"):
                yield where, [*data[:index], new, *data[index + 1 :]]


def test_whatever_msgspec_refuses_of_a_vehicle_is_said_where_it_is(tmp_path: Path):
    write_vehicle(one_of_everything(), tmp_path / "a")
    data = tomllib.loads((tmp_path / "a/vehicle.toml").read_text("utf-8"))
    n_refused = 0
    for where, new in changed(data):
        try:
            msgspec.convert(new, VehicleRecord)
        except msgspec.ValidationError:
            n_refused += 1
            with pytest.raises(VehicleError) as caught:
                decode(new, VehicleRecord)
            assert str(caught.value).startswith(where), (where, new)
    assert n_refused > 1000
