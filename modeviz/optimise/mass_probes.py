"""Probes for the mass of an absorber, which goes where its spring does.

Its guide lets it move from what carries it by s along some axes a and no others, and turn as that does.
So with u the motion of the carrier where the absorber sits, and u + Σ a s that of the mass, the energy
of the mass is all that depends on the place:

    m (u + Σ a s)² / 2  + I θ² / 2,  ∂(2T)/∂p = 2 m (u + Σ a s) · (∂u/∂p + Σ s ∂a/∂p) + 2 I θ · ∂θ/∂p

and each product is a sum of squares of rows that mounts have. Of a step d along an axis, with ∂
standing for Σ w over both steps,

    2 (u + Σ a s) · ∂u = ∂c² - ∂r² + ∂e² - ∂h²

c is the motion of the carrier there, e and h those of the mass and of the carrier at the end of a rigid
arm d from where they are, and r = e - c. On a rigid carrier c = h, and r does not depend on d. Of an
angle, with E the same sum of axes b bᵀ that are held, which are turned, (Σ a s) E (Σ a s) = 0 and

    2 (u + Σ a s) · Σ s ∂a = - (u + Σ a s) E (u + Σ a s) + u E u

where turning within the plane of several a is that of the springs, which other probes tell of.

Under a load that stays the weight m g pulls along u + Σ a s, of which the same is taken: m g · ∂u, and
m g · Σ s ∂a = - g E (Σ a s) m, along the motion of the mass from its carrier.
"""

from collections.abc import Iterator
from dataclasses import replace

from modeviz.optimise.place_variables import PlaceVariable
from modeviz.optimise.probe import ALONG, SHIFTS, MassProbe
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.carried_mass import CarriedMass
from modeviz.vehicle.connections import GROUND, Mount


def mass_probes(
    number: int, variable: PlaceVariable, mount: int, given: Mount, carried: CarriedMass
) -> Iterator[MassProbe]:
    """Yield the probes of a place of an absorber.

    Args:
        number: of the variable.
        variable: the place.
        mount: the number of its spring among all mounts.
        given: that spring, where it was given.
        carried: its mass.
    """
    body, carrier = carried.body.name, carried.carrier.name
    plain = MassProbe(
        number, variable, SHIFTS[variable.kind][0], mount, given, False, "inerter",
        (body, GROUND), carried.body.mass,
    )  # fmt: skip
    on_carrier = replace(plain, ends=(carrier, GROUND))
    if variable.kind == "angles":
        held = tuple(f for f, is_held in zip(ALONG, carried.held, strict=True) if is_held)
        between = replace(plain, mass=0.0, ends=(body, carrier), weight=-plain.mass)
        turned = _less(plain), on_carrier, between
        parts = tuple(replace(part, along=held) for part in turned) if held else ()
    else:
        parts = (replace(plain, has_arm=True, weight=plain.mass),)
        if not isinstance(carried.carrier, RigidBody):
            parts = (
                replace(plain, has_arm=True),
                replace(_less(on_carrier), has_arm=True),
                replace(on_carrier, inertia=carried.inertia, weight=plain.mass),
                replace(_less(plain), ends=(carrier, body)),
            )
    for shift in SHIFTS[variable.kind]:
        yield from (replace(part, shift=shift) for part in parts)


def _less(probe: MassProbe) -> MassProbe:
    """Return the probe that counts for as much less."""
    return replace(probe, mass=-probe.mass)
