"""What a page shows as a text that fits into the address of one, and back, whoever wrote it."""

import base64
import binascii
import zlib
from dataclasses import dataclass, field, replace
from urllib.parse import parse_qs, urlsplit

from modeviz.errors import ModevizError, quoted
from modeviz.vehicle.absorber_parts import absorber_spring
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.design import current_set
from modeviz.viewer.session.encoding.fit_design import outside_bounds
from modeviz.viewer.session.encoding.fitting import check_fits, fitted
from modeviz.viewer.session.encoding.text import text_of, value_of_text
from modeviz.viewer.session.opening import Opening
from modeviz.viewer.session.state import State
from modeviz.viewer.session.view import Animation, CameraPose

WHAT = "state link"

LONGEST_LINK = 7_500
"""Letters: servers refuse addresses of 8 192. A hundred mount groups take five thousand."""

LONGEST_TEXT = 1_000_000
"""Bytes that a link may unpack to."""


@dataclass(frozen=True)
class _Linked:
    """All that a link holds: of whom it is, who may see what, and where files lie, is no part of it."""

    vehicle: str
    """Its name."""
    fingerprint: str
    """Of what it is made of."""
    state: State
    animation: Animation = field(default_factory=Animation)
    camera: CameraPose | None = None


def link_of(
    state: State, animation: Animation, camera: CameraPose | None, vehicle: Vehicle, fingerprint: str
) -> str:
    """Return a text, letters, digits, "-" and "_", that `opening_of_link` reads.

    Of the variants it has those that are drawn, and it has no plan of a search: it shows a view.

    Args:
        state: that is shown.
        animation: how it moves.
        camera: of the page; None: as a page opens with.
        vehicle: altered as in the state.
        fingerprint: of the vehicle as in its files.

    Raises:
        ModevizError: that is too much for an address.
    """
    linked = _Linked(vehicle.name, fingerprint, _shown(state, vehicle), animation, camera)
    packed = zlib.compress(text_of(linked).encode(), 9)
    link = base64.urlsafe_b64encode(packed).decode().rstrip("=")
    if len(link) > LONGEST_LINK:
        raise ModevizError(
            f"{WHAT}: this view takes {len(link):,} letters, an address has room for {LONGEST_LINK:,}: "
            "draw fewer variants beside"
        )
    return link


def opening_of_link(link: str, usual: State, vehicle: Vehicle, fingerprint: str) -> Opening:
    """Return what a text of `link_of` shows.

    Args:
        link: what stands behind "view=" in an address, by whomever.
        usual: what is shown of the vehicle at first, for what the link does not say.
        vehicle: as in its files.
        fingerprint: of that.

    Raises:
        ModevizError: it is no such text, or of this very vehicle, which cannot be so.
    """
    linked = value_of_text(_unpacked(link), _Linked, WHAT)
    state = _with_usual_plan(linked.state, usual)
    if (linked.vehicle, linked.fingerprint) == (vehicle.name, fingerprint):
        check_fits(state, usual, vehicle, WHAT)
        return Opening(state, animation=linked.animation, camera=linked.camera)
    found = fitted(state, usual, vehicle)
    remarks = (
        _of_another(linked.vehicle, vehicle),
        *found.remarks,
        *outside_bounds(found.state.design, vehicle),
    )
    return Opening(found.state, animation=linked.animation, camera=linked.camera, remarks=remarks)


def view_in(address: str) -> str:
    """Return what stands behind "view=" in the address of a page, or a text without that as it is."""
    try:
        return parse_qs(urlsplit(address).query).get("view", [address])[0]
    except ValueError:
        return address


def _of_another(name: str, vehicle: Vehicle) -> str:
    if name != vehicle.name:
        return f"the link is of {quoted(name)}, and this is {vehicle.name!r}: what fits is taken"
    return f"vehicle {vehicle.name!r} has changed since the link was made: what fits is taken"


def _shown(state: State, vehicle: Vehicle) -> State:
    """A state with those variants alone that are drawn or that it is, and without a plan."""
    drawn = {*state.charts.overlaid, state.against, current_set(vehicle, state.design)}
    variants = {name: each for name, each in state.design.variants.items() if name in drawn}
    return replace(state, design=replace(state.design, variants=variants, plan=None))


def _with_usual_plan(state: State, usual: State) -> State:
    """A state with the plan that its vehicle would have."""
    plan = usual.design.plan
    for absorber in state.design.alterations.absorbers:
        plan = plan and plan.with_mounts(absorber_spring(absorber))
    return replace(state, design=replace(state.design, plan=plan))


def _unpacked(link: str) -> bytes:
    """The text in a link; not more of it is unpacked than anybody needs."""
    if len(link) > LONGEST_LINK:
        raise ModevizError(f"{WHAT}: found {len(link):,} letters, expected at most {LONGEST_LINK:,}")
    unpacking = zlib.decompressobj()
    try:
        packed = base64.b64decode(link + "=" * (-len(link) % 4), altchars=b"-_", validate=True)
        text = unpacking.decompress(packed, LONGEST_TEXT)
    except (binascii.Error, ValueError, zlib.error):
        raise ModevizError(_cut_off(link)) from None
    if unpacking.unconsumed_tail:
        raise ModevizError(f"{WHAT}: unpacks to more than {LONGEST_TEXT:,} bytes")
    if not unpacking.eof:
        raise ModevizError(_cut_off(link))
    return text


def _cut_off(link: str) -> str:
    return f"{WHAT}: found {quoted(link)}, which is cut off or altered: copy all of the link"
