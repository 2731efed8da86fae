"""The bodies that a bushing joins: those it names, or those whose attachments are where it is."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

from modeviz.errors import VehicleError, listed, quoted, unknown
from modeviz.files.mount_tables.bushing import Bushing, End
from modeviz.files.mount_tables.records import Joined
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Attachment, Body, FlexibleBody
from modeviz.vehicle.checks import REACH
from modeviz.vehicle.connections import GROUND
from modeviz.vehicle.vehicle import Vehicle

ALIKE = 1e-3
"""m: of places that differ by less in how far they are none is the nearer one."""


@dataclass(frozen=True, eq=False)
class _Candidate:
    """A body that an end may hold on to."""

    body: str
    place: Floats | None
    """(3,), m; None: it is not said."""
    distance: float
    """m, of the end's place from the body's nearest attachment."""


class Ends:
    """The bodies and attachments of a vehicle, in the axes of its file."""

    def __init__(self, vehicle: Vehicle, axes: Floats) -> None:
        self._vehicle = vehicle
        self._axes = axes

    def joined(self, bushing: Bushing) -> Joined:
        """Return what a bushing holds on to.

        Ends that name neither body nor attachment are on the bodies whose attachments are nearest.

        Raises:
            VehicleError: there is no such body or attachment, or none within `REACH`; or several are
                as near. The text says which end.
        """
        known: dict[int, _Candidate] = {}
        for i, end in enumerate(bushing.ends):
            if candidate := self._known(end):
                known[i] = candidate
        if len(known) < 2:
            known |= self._nearest(bushing, known)
        first, second = known[0], known[1]
        if first.body == second.body:
            raise VehicleError(f"{bushing.ends[1].where}: joins {quoted(first.body)} to itself")
        return Joined((first.body, second.body), self._places(bushing, first, second))

    def _places(
        self, bushing: Bushing, first: "_Candidate", second: "_Candidate"
    ) -> tuple[Floats, Floats]:
        """Where a bushing acts on both; an end without a place is where the other one is.

        Raises:
            VehicleError: neither has a place, or one is beyond the reach of its body's attachments.
        """
        found = [
            one.place if one.place is not None else other.place
            for one, other in ((first, second), (second, first))
        ]
        places = [bushing.acts_at] * 2 if bushing.acts_at is not None else found
        reached: list[Floats] = []
        for end, candidate, place in zip(bushing.ends, (first, second), places, strict=True):
            if place is None:
                raise VehicleError(
                    f"{end.where}: on {quoted(candidate.body)}, but neither place nor attachment"
                )
            if candidate.body != GROUND:
                self._reached(end, self._vehicle.body(candidate.body), place)
            reached.append(place)
        return reached[0], reached[1]

    def _attachments(self) -> Iterator[tuple[str, Attachment]]:
        """Those of all bodies, each with its body's name."""
        for body in self._vehicle.bodies:
            if isinstance(body, FlexibleBody):
                yield from ((body.name, attachment) for attachment in body.attachments)

    def is_far(self, bushing: Bushing) -> bool:
        """Whether nothing of the vehicle is near a bushing, as far as that is looked for at all."""
        return all(
            end.body == GROUND or (end.may_be_elsewhere and not end.body and not self._is_near(end))
            for end in bushing.ends
        )

    def _is_near(self, end: End) -> bool:
        named = any(attachment.name == end.attachment for _, attachment in self._attachments())
        return named or bool(self._candidates(end))

    def _known(self, end: End) -> _Candidate | None:
        """What an end names, if anything."""
        if end.body.lower() == GROUND:
            return _Candidate(GROUND, end.place, 0.0)
        body = self._body(end)
        if end.may_be_elsewhere:
            if likely := self._likely(end, body):
                return likely
        elif end.attachment:
            return self._at_attachment(end, body)
        return None if body is None else _Candidate(body.name, end.place, 0.0)

    def _likely(self, end: End, body: Body | None) -> _Candidate | None:
        """The body with an attachment of an end's number at its place; None if not one has it.

        Raises:
            VehicleError: attachments have the number, all are elsewhere, and nothing else is there.
        """
        assert end.place is not None
        found = [
            _Candidate(name, end.place, float(np.linalg.norm(a.position @ self._axes - end.place)))
            for name, a in self._attachments()
            if a.name == end.attachment and (body is None or name == body.name)
        ]
        near = [candidate for candidate in found if candidate.distance <= REACH]
        if found and not near and not self._candidates(end):
            far = min(found, key=lambda candidate: candidate.distance)
            raise VehicleError(
                f"{end.where}: is at {_at(end.place)}, and the attachment {quoted(end.attachment)} of "
                f"{quoted(far.body)} {1000 * far.distance:.4g} mm from there; is the body moved, or "
                "are the units others?"
            )
        return near[0] if len(near) == 1 else None

    def _body(self, end: End) -> Body | None:
        names = [body.name for body in self._vehicle.bodies]
        if end.body and end.body not in names:
            raise VehicleError(f"{end.where}: {unknown('body', end.body, [*names, GROUND])}")
        return self._vehicle.body(end.body) if end.body else None

    def _at_attachment(self, end: End, body: Body | None) -> _Candidate:
        every = [(n, a) for n, a in self._attachments() if body is None or n == body.name]
        found = [(name, a) for name, a in every if a.name == end.attachment]
        if not found:
            what = f"attachment of {quoted(body.name)}" if body else "attachment"
            raise VehicleError(
                f"{end.where}: {unknown(what, end.attachment, [a.name for _, a in every])}"
            )
        if len(found) > 1:
            raise VehicleError(
                f"{end.where}: {listed(name for name, _ in found)} have an attachment "
                f"{quoted(end.attachment)} each; name the body too"
            )
        ((name, attachment),) = found
        own = attachment.position @ self._axes
        place = own if end.place is None else end.place
        holder = self._vehicle.body(name)
        distance = self._reached(end, holder, place)
        if isinstance(holder, FlexibleBody) and distance < np.linalg.norm(place - own) - ALIKE:
            nearest = holder.nearest_attachment(self._axes @ place)
            raise VehicleError(
                f"{end.where}: its place {_at(place)} is nearer to the attachment "
                f"{quoted(nearest.name)} than to {quoted(end.attachment)}; leave the place out"
            )
        return _Candidate(name, place, distance)

    def _reached(self, end: End, body: Body, place: Floats) -> float:
        """How far a place is from the nearest attachment of a body, m; raises if beyond `REACH`."""
        distance, name = self._distance(body, place)
        if distance > REACH:
            raise VehicleError(
                f"{end.where}: {_at(place)} is {1000 * distance:.4g} mm from {name}, the nearest "
                f"attachment of {quoted(body.name)}; expected at most {1000 * REACH:g} mm"
                if name
                else f"{end.where}: {quoted(body.name)} has no attachment; import it with --attach"
            )
        return distance

    def _distance(self, body: Body, place: Floats) -> tuple[float, str]:
        """How far a body's nearest attachment is, and its name; a rigid body is everywhere."""
        if not isinstance(body, FlexibleBody):
            return 0.0, ""
        if not body.attachments:
            return np.inf, ""
        nearest = body.nearest_attachment(self._axes @ place)
        return float(np.linalg.norm(nearest.position @ self._axes - place)), quoted(nearest.name)

    def _nearest(self, bushing: Bushing, known: dict[int, _Candidate]) -> dict[int, _Candidate]:
        """The bodies nearest to the ends of which nothing is known, by which end."""
        lots = [[known[i]] if i in known else self._candidates(bushing.ends[i]) for i in (0, 1)]
        pairs = sorted(
            ((a.distance + b.distance, a, b) for a, b in product(*lots) if a.body != b.body),
            key=lambda pair: pair[0],
        )
        unnamed = next(end for i, end in enumerate(bushing.ends) if i not in known)
        if not pairs:
            near = sorted({candidate.body for lot in lots for candidate in lot})
            raise VehicleError(
                f"{unnamed.where}: no two bodies have attachments within {1000 * REACH:g} mm of it, "
                f"only {listed(near)}; name the bodies"
            )
        total, first, second = pairs[0]
        bodies = {first.body, second.body}
        rivals = [p for p in pairs[1:] if {p[1].body, p[2].body} != bodies and p[0] < total + ALIKE]
        if rivals:
            names = sorted({*bodies, rivals[0][1].body, rivals[0][2].body})
            raise VehicleError(f"{unnamed.where}: {listed(names)} are equally near; name the bodies")
        return {0: first, 1: second}

    def _candidates(self, end: End) -> list[_Candidate]:
        """The flexible bodies with an attachment near an end."""
        if end.place is None:
            raise VehicleError(f"{end.where}: empty, expected a body, an attachment or a place")
        found = []
        for body in self._vehicle.bodies:
            if isinstance(body, FlexibleBody):
                distance, _ = self._distance(body, end.place)
                if distance <= REACH:
                    found.append(_Candidate(body.name, end.place, distance))
        return found


def _at(place: Floats) -> str:
    return f"[{', '.join(f'{value:.6g}' for value in place)}] m"
