"""The display mesh of every body."""

from collections.abc import Mapping

from modeviz.vehicle.bodies import Mesh
from pickup.dressing import box, cab, engine, frame, front_end, suspension
from pickup.half_mesh import Structure
from pickup.materials import Piece, display_mesh
from pickup.parameters import Parameters
from pickup.sides import SIDES, Side


def display_meshes(structures: Mapping[str, Structure], p: Parameters) -> dict[str, Mesh]:
    """The display meshes by body; what moves with a body is in its mesh alone.

    Args:
        structures: of the flexible bodies, whose panels are drawn.
        p: where mounts and springs are.
    """
    pieces = {
        "front end": front_end.pieces(structures["front end"].mesh),
        "cab": cab.pieces(structures["cab"].mesh),
        "box": box.pieces(structures["box"].mesh),
        "frame": frame.pieces(p),
        "engine": engine.pieces(p),
        "rear axle": suspension.rear_axle(p),
        "propshaft": suspension.propshaft(),
        "steering linkage": suspension.steering_linkage(),
    }
    for side in SIDES:
        pieces[f"knuckle {side}"] = _on(side, suspension.knuckle())
        pieces[f"lower arm {side}"] = _on(side, suspension.lower_arm())
        pieces[f"upper arm {side}"] = _on(side, suspension.upper_arm())
    return {body: display_mesh(own) for body, own in pieces.items()}


def _on(side: Side, right: list[Piece]) -> list[Piece]:
    return [Piece(p.material, p.surface.mirrored()) for p in right] if side == "left" else right
