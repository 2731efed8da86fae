"""Links to what a page shows: the same again on another day, and nothing of a stranger's believed."""

import base64
import json
import zlib
from dataclasses import replace

import pytest
from every_command import VEHICLE

from modeviz.analysis.results import Conditions
from modeviz.errors import LONGEST, ModevizError
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.placement import Placement
from modeviz.viewer.session.commands import decisions, looks
from modeviz.viewer.session.commands.absorbers import AddAbsorber
from modeviz.viewer.session.design import Variant
from modeviz.viewer.session.encoding.link import (
    LONGEST_LINK,
    LONGEST_TEXT,
    link_of,
    opening_of_link,
    view_in,
)
from modeviz.viewer.session.state import first_state
from modeviz.viewer.session.view import Animation, CameraPose

FIRST = first_state(VEHICLE, VEHICLE.rates, Conditions("flat", 20.0))
PRINT = "f" * 64
CAMERA = CameraPose((3.0, -4.0, 2.5), (1.0, 0.0, 0.7))
MOVING = Animation(1.85, 0.75, 215.0, False)


def seen():
    """A state in which much is other than at first."""
    state = FIRST
    for command in (
        decisions.Pin("Left out"),
        decisions.SetRate("B", "lateral", 123456.7),
        decisions.SetLossFactor("A", 0.31),
        decisions.PlaceMounts("B", "offset", (0.01, None, -0.002)),
        decisions.Pin("Kept"),
        decisions.SetRate("A", "vertical", 5.5e5),
        looks.ShowMode("cab roll"),
        looks.ChangeLook(coloring="kinetic energy", see_through=False),
        looks.ChooseCurve(1, FIRST.charts.curves[0]),
        looks.ChangeCharts(cursor_hz=9.3, decibels=False),
        looks.Overlay("Kept", True),
        looks.Drive("rough", 25.0),
    ):
        state = command.apply(state, VEHICLE)
    return state


SEEN = seen()


def opened(link, vehicle=VEHICLE, fingerprint=PRINT):
    usual = first_state(vehicle, vehicle.rates, Conditions("flat", 20.0))
    return opening_of_link(link, usual, vehicle, fingerprint)


def packed(data):
    """What a stranger would put into a link."""
    text = data if isinstance(data, bytes) else json.dumps(data).encode()
    return base64.urlsafe_b64encode(zlib.compress(text)).decode().rstrip("=")


def unpacked(link):
    return json.loads(zlib.decompress(base64.urlsafe_b64decode(link + "=" * (-len(link) % 4))))


def test_a_link_opens_what_was_shown_with_its_camera_and_motion():
    link = link_of(SEEN, MOVING, CAMERA, VEHICLE, PRINT)
    opening = opened(link)
    design = replace(SEEN.design, variants={"Kept": SEEN.design.variants["Kept"]})
    assert opening.state == replace(SEEN, design=design)
    assert (opening.animation, opening.camera, opening.remarks) == (MOVING, CAMERA, ())
    assert (opening.past, opening.future) == ((), ())


def test_a_link_is_letters_of_an_address_and_found_in_one():
    link = link_of(SEEN, MOVING, None, VEHICLE, PRINT)
    assert link.replace("-", "").replace("_", "").isalnum()
    assert view_in(f"https://bench.example.com/truck/?vehicle=pickup&view={link}") == link
    assert view_in(link) == link
    assert view_in("http://[") == "http://["
    assert opened(link).camera is None


def test_a_link_says_nothing_of_what_is_not_shown():
    """Neither sets that are not drawn, nor what is sought, nor where the vehicle lies."""
    vehicle = replace(VEHICLE, file="secret/place/vehicle.toml", notes=("secret note",))
    text = json.dumps(unpacked(link_of(SEEN, MOVING, CAMERA, vehicle, PRINT)))
    assert "Left out" not in text
    assert "Kept" in text
    assert "secret" not in text
    assert '"plan": null' in text


def test_a_view_with_an_absorber_has_a_plan_that_may_tune_it():
    absorber = Absorber("roof", "cab", (1.2, 0.0, 1.6), 10.0, 9.0, 0.1)
    state = AddAbsorber(absorber).apply(decisions.Load("Original").apply(SEEN, VEHICLE), VEHICLE)
    opening = opened(link_of(state, MOVING, CAMERA, VEHICLE, PRINT))
    assert opening.state.design.alterations == state.design.alterations
    assert opening.state.design.plan == state.design.plan


def test_a_set_that_was_pinned_with_an_absorber_has_it_behind_the_link():
    absorber = Absorber("roof", "cab", (1.2, 0.0, 1.6), 10.0, 9.0, 0.1)
    with_it = with_absorbers(VEHICLE, [absorber])
    state = decisions.Load("Original").apply(SEEN, VEHICLE)
    state = AddAbsorber(absorber).apply(state, VEHICLE)
    state = decisions.Pin("Kept with it").apply(state, with_it)
    state = decisions.Load("Original").apply(state, with_it)
    state = replace(state, against="Kept with it").with_known_parts(state.design, VEHICLE)
    opening = opened(link_of(state, MOVING, CAMERA, VEHICLE, PRINT))
    assert opening.state.against == "Kept with it"
    assert opening.state.design.variants["Kept with it"].absorbers == (absorber,)
    assert opening.state.design.variants["Kept with it"].rates.keys() == with_it.rates.keys()
    assert not opening.state.design.alterations.absorbers


def test_a_link_of_a_vehicle_that_has_changed_says_so_and_takes_what_fits():
    link = link_of(SEEN, MOVING, CAMERA, VEHICLE, PRINT)
    changed = replace(VEHICLE, mount_groups=VEHICLE.mount_groups[:1])
    opening = opened(link, changed, "0" * 64)
    assert opening.state.design.rates == {"A": SEEN.design.rates["A"]}
    assert opening.state.look == SEEN.look
    assert opening.camera == CAMERA
    assert "has changed" in opening.remarks[0]
    assert any("unknown mount group 'B'" in remark for remark in opening.remarks)
    renamed = replace(VEHICLE, name="van")
    told = opened(link, renamed).remarks
    assert told == ("the link is of 'cabin', and this is 'van': what fits is taken",)


def test_a_link_of_this_vehicle_that_does_not_fit_it_is_none_of_ours():
    data = unpacked(link_of(SEEN, MOVING, CAMERA, VEHICLE, PRINT))
    data["content"]["state"]["group"] = "nobody"
    with pytest.raises(ModevizError, match=r"state link: unknown mount group 'nobody'"):
        opened(packed(data))


def with_value(*path, value):
    data = unpacked(link_of(SEEN, MOVING, CAMERA, VEHICLE, PRINT))
    inner = data["content"]
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = value
    return packed(data)


GOOD = link_of(SEEN, MOVING, CAMERA, VEHICLE, PRINT)
BOMB = packed(b"[" + b"0," * 50_000_000 + b"0]")
HOSTILE = {
    "nothing": "",
    "no base64": "?" * 40,
    "not ASCII": "ä" * 40,
    "no zlib": base64.urlsafe_b64encode(b"x" * 100).decode(),
    "cut off": GOOD[: len(GOOD) // 2],
    "one letter other": GOOD[:50] + ("A" if GOOD[50] != "A" else "B") + GOOD[51:],
    "too long": "A" * (LONGEST_LINK + 1),
    "a bomb": BOMB[:LONGEST_LINK],
    "a small bomb": packed(b" " * (LONGEST_TEXT + 1)),
    "no JSON": packed(b"{"),
    "deep": packed(b"[" * 100_000),
    "no state": with_value("state", value=None),
    "a camera nowhere": with_value("camera", "position", value=[1e300, 0, 0]),
    "a camera too far": with_value("camera", "position", value=[1e9, 0, 0]),
    "a camera that looks at itself": with_value("camera", "look_at", value=[3.0, -4.0, 2.5]),
    "a camera in a plane": with_value("camera", "position", value=[1, 2]),
    "an amplitude beyond the slider": with_value("animation", "amplitude", value=3.1),
    "no phase": with_value("animation", "phase", value=None),
    "a token": with_value("token", value="x"),
}


@pytest.mark.parametrize("link", HOSTILE.values(), ids=HOSTILE)
def test_what_nobody_of_us_linked_to_is_refused_in_a_sentence(link):
    with pytest.raises(ModevizError, match=r"^state link") as refusal:
        opened(link)
    assert len(str(refusal.value)) <= LONGEST


def test_no_more_is_unpacked_than_anybody_needs(monkeypatch):
    """The bomb above would be 100 MB; what is given out is bounded before it is there."""
    given = []
    unpack = zlib.decompressobj

    class Watched:
        def __init__(self):
            self._inner = unpack()

        def decompress(self, data, most):
            given.append(self._inner.decompress(data, most))
            return given[-1]

        def __getattr__(self, name):
            return getattr(self._inner, name)

    monkeypatch.setattr("modeviz.viewer.session.encoding.link.zlib.decompressobj", Watched)
    with pytest.raises(ModevizError):
        opened(HOSTILE["a small bomb"])
    assert max(map(len, given)) <= LONGEST_TEXT


def test_a_view_that_no_address_has_room_for_is_said():
    many = {f"set {i}": Variant({"A": MountRates(1e5 + i / 7, 2e5 + i / 11, 3e5 + i / 13)}, i,
                                {"A": Placement((i / 1e4 / 3, 0, 0))}) for i in range(400)}  # fmt: skip
    state = replace(
        FIRST,
        design=replace(FIRST.design, variants=many),
        charts=replace(FIRST.charts, overlaid=frozenset(many)),
    )
    with pytest.raises(ModevizError, match=r"an address has room for 7,500"):
        link_of(state, MOVING, CAMERA, VEHICLE, PRINT)
    link_of(replace(state, charts=FIRST.charts), MOVING, CAMERA, VEHICLE, PRINT)
