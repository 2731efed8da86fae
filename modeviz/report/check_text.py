"""The words for what there is in a vehicle folder, see `report.check`."""

from collections.abc import Iterator, Sequence

from modeviz.report.check import Held, Summary, Weighed
from modeviz.report.tables import table
from modeviz.vehicle.islands import Island

MOST_LISTED = 5
"""Of connections by how far their attachments are."""


def summary_text(summary: Summary) -> str:
    """The summary as a table of bodies and sentences on what joins them."""
    rows = [_row(body) for body in summary.bodies]
    header = ["body", "kg", "centre of gravity x, y, z m", "first free modes Hz", "orthogonality error"]
    total = [summary.total.name, *_row(summary.total)[1:3], "", ""]
    return "\n".join(
        [
            table(header, [*rows, total]),
            "Places are in the vehicle's axes: x rearward, y right, z up.",
            "",
            _front(summary.front),
            *_reach(summary.held),
            *_hanging(summary.islands),
            *_free(summary),
        ]
    )


def _row(body: Weighed) -> list[str]:
    error = body.orthogonality_error
    return [
        body.name,
        f"{body.mass:.5g}",
        ", ".join(f"{x:.3f}" for x in body.center_of_gravity + 0.0),
        "rigid" if error is None else ", ".join(f"{f:.4g}" for f in body.first_hz) or "none",
        "" if error is None else f"{error:.1g}",
    ]


def _front(reasons: Sequence[str]) -> str:
    if not reasons:
        return (
            "The front is taken to be where x is least, after the axes that the file says: no name "
            "with front or rear and no axle tells."
        )
    return f"The front is where x is least: {'; '.join(reasons)}."


def _reach(held: Sequence[Held]) -> Iterator[str]:
    if not held:
        return
    farthest = [h for h in held[:MOST_LISTED] if round(1000 * h.distance, 1)]
    yield f"Connections hold on to flexible bodies in {len(held)} places" + (
        ", all at an attachment." if not farthest else ", the farthest from their attachments:"
    )
    for h in farthest:
        yield (
            f"  {h.connection!r} {1000 * h.distance:.1f} mm from the attachment {h.attachment!r} of "
            f"{h.body!r}"
        )


def _hanging(found: Sequence[Island]) -> Iterator[str]:
    for island in found:
        n = len(island.bodies)
        if n == 1:
            yield _alone(island, len(found) == 1)
            continue
        ground = "they hold on to the ground" if island.is_held else "nothing holds them to the ground"
        together = f"All {n} bodies hang" if len(found) == 1 else f"{_listed(island.bodies)} hang"
        yield f"{together} together; {ground}."


def _alone(island: Island, is_only: bool) -> str:
    (name,) = map(repr, island.bodies)
    if is_only:
        return (
            f"{name} is the only body, and {'' if island.is_held else 'not '}connected to the ground."
        )
    ground = "only the ground is" if island.is_held else "nor is the ground"
    return f"{name} is isolated: no other body is connected to it, {ground}."


def _listed(bodies: Sequence[str]) -> str:
    *others, last = map(repr, bodies)
    return f"{', '.join(others)} and {last}"


def _free(summary: Summary) -> Iterator[str]:
    if summary.why_not:
        yield f"Mechanisms cannot be looked for: {summary.why_not}."
        return
    whole = [motion for motion in summary.free if motion.is_whole]
    for bodies in dict.fromkeys(motion.bodies for motion in whole):
        how = _moves([motion.motion for motion in whole if motion.bodies == bodies])
        what = f"{bodies[0]!r}" if len(bodies) == 1 else f"What hangs together with {bodies[0]!r}"
        yield f"{what} is free as a whole: it {how}."
    mechanisms = [motion for motion in summary.free if not motion.is_whole]
    for motion in mechanisms:
        first, *others = map(repr, motion.bodies)
        together = f" together with {', '.join(others)}" if others else ""
        yield f"Mechanism: {first} {_moves([motion.motion])}{together}, and nothing holds it."
    if not mechanisms:
        yield "There are no mechanisms: nothing within the vehicle moves freely."


def _moves(motions: Sequence[str]) -> str:
    along = ", ".join(motion for motion in motions if not motion.startswith("r"))
    about = ", ".join(motion[1] for motion in motions if motion.startswith("r"))
    words = {"moves along": along, "turns about": about}
    return " and ".join(f"{word} {axes}" for word, axes in words.items() if axes)
