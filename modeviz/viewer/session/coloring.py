"""What colours mean in an answer: shares of an energy, and the scale they are drawn on."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.energy import kinetic_energy
from modeviz.shapes.colors import (
    Color,
    Shade,
    color_map,
    displacement_shade,
    motion_shades,
    share_shade,
)
from modeviz.shapes.motion import DRAWN_FRACTION
from modeviz.text.wording import sentence_case
from modeviz.vehicle.arrays import Array
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.state import Coloring

Shares = Mapping[str, float]
"""Of an energy, 0 to 1, by name of body and mount group."""


@dataclass(frozen=True)
class ColorScale:
    """The scale of the bodies' colours: they go from nothing to `last`."""

    quantity: str
    """In sentence case."""
    last: str
    """What has the last colour."""
    about: str
    """A longer explanation."""


def color_scale(solved: Solved) -> ColorScale | None:
    """The scale of the colours in an answer; None if bodies have their own."""
    coloring = solved.state.look.coloring
    if coloring == "bodies":
        return None
    if coloring == "displacement":
        last, about = 1.0, "Relative to the largest on the bodies"
    else:
        last, about = largest_share(energy_shares(solved)), "Share of each body in the whole vehicle's"
    return ColorScale(sentence_case(coloring), f"{100 * last:.0f} %", about)


def energy_shares(solved: Solved) -> Shares:
    """The shares that colours stand for; none unless bodies are coloured by an energy.

    By body for kinetic energy, by flexible body and mount group for strain energy.
    """
    if solved.state.look.coloring == "kinetic energy":
        energy = kinetic_energy(solved.now.prepared.system, solved.movement.shape[:, None])
        return {body: float(share[0]) for body, share in energy.items()}
    if solved.state.look.coloring == "strain energy":
        drawn = _strained(solved.now.prepared.vehicle)
        return {name: share for name, share in strain_shares(solved).items() if name in drawn}
    return {}


def strain_shares(solved: Solved) -> Shares:
    """The strain energy of what moves: each flexible body's and connection group's share."""
    if solved.movement.shape is solved.followed.shape:
        return solved.strain
    return solved.now.strain_shares(solved.movement.shape, solved.movement.frequency_hz)


def largest_share(shares: Shares) -> float:
    """The share that has the last colour of the scale; the first one stands for nothing."""
    return max(shares.values(), default=0.0)


def share_colors(shares: Shares) -> Mapping[str, Color]:
    """The sRGB colour of each share."""
    colors = color_map(np.array([*shares.values()]) / (largest_share(shares) or 1.0)).tolist()
    return dict(zip(shares, map(tuple, colors), strict=True))


def shades(
    coloring: Coloring, drawn: Mapping[str, Array], length: float, shares: Shares
) -> dict[str, Shade]:
    """Return the shades of bodies, by name; without a shade they have their own colours.

    Displacement is relative to the largest. Kinetic energy varies over a body as `motion_shades` tells.
    Strain energy is one colour for a whole body: that of its share. Bodies that are rigid have none.

    Args:
        coloring: what the colours mean.
        drawn: displacements by body as they are drawn, (n_vertices, 3), m.
        length: of the vehicle, m.
        shares: of the energy, by body.
    """
    largest = largest_share(shares)
    match coloring:
        case "displacement":
            return dict.fromkeys(drawn, displacement_shade(DRAWN_FRACTION * length))
        case "kinetic energy":
            return motion_shades(shares, drawn, largest)
        case "strain energy":
            return {body: share_shade(shares.get(body, 0.0), largest) for body in drawn}
        case _:
            return {}


def _strained(vehicle: Vehicle) -> set[str]:
    """The bodies and mount groups that can hold strain energy and are drawn."""
    flexible = {body.name for body in vehicle.bodies if isinstance(body, FlexibleBody)}
    return flexible | {group.name for group in vehicle.mount_groups}
