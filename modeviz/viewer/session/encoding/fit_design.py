"""What of a design fits a vehicle: rates, variants, places, absorbers, locks."""

from collections.abc import Mapping
from dataclasses import replace
from math import tau

from modeviz.errors import ModevizError
from modeviz.report.rate_fields import spoken
from modeviz.text.wording import free_name
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.alterations import Alterations
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import RATE_FIELDS, MountRates, Rates
from modeviz.vehicle.placement import Placements, check_placements
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.design import STIFFEST, Design, Variant, known_sets
from modeviz.viewer.session.encoding.fit_plan import fitted_plan
from modeviz.viewer.session.encoding.remarks import Remarks

LONGEST_NAME = 200
"""Letters of what somebody calls a variant or an absorber."""

MOST_VARIANTS, MOST_ABSORBERS = 500, 50

FARTHEST = 1e3
"""m: of a mount from where it was given."""

HEAVIEST = 1e5
"""kg: of an absorber, as on the page."""

LARGEST_LOSS = 10.0
"""No mount loses more of its stiffness."""


def fitted_absorbers(
    absorbers: tuple[Absorber, ...], vehicle: Vehicle, remarks: Remarks
) -> tuple[Absorber, ...]:
    """Return the absorbers that a vehicle can have."""
    kept: list[Absorber] = []
    if not remarks.few("absorbers", absorbers, MOST_ABSORBERS):
        absorbers = absorbers[:MOST_ABSORBERS]
    for absorber in absorbers:
        if not remarks.short("absorber", absorber.name, LONGEST_NAME):
            continue
        mass = remarks.within(f"mass of absorber {absorber.name!r}, kg", absorber.mass, 0.0, HEAVIEST)
        try:
            with_absorbers(vehicle, [*kept, light := replace(absorber, mass=mass)])
        except ModevizError as error:
            remarks.say(error)
        else:
            kept.append(light)
    return tuple(kept)


def fitted_design(
    design: Design, usual: Design, given: Vehicle, vehicle: Vehicle, remarks: Remarks
) -> Design:
    """Return what of a design a vehicle can have.

    Args:
        design: that is asked for, with absorbers that fit.
        usual: of the vehicle, for what does not.
        given: the vehicle as in its file.
        vehicle: with these absorbers, and no mount moved.
        remarks: told of what does not fit.
    """
    groups = {group.name: group for group in vehicle.mount_groups}
    alterations = design.alterations
    return replace(
        design,
        rates=_every_rate(design.rates, groups, vehicle, remarks),
        variants=_variants(design.variants, given, remarks),
        locked=frozenset(_locked(design.locked, groups, remarks)),
        linked=frozenset(remarks.some("mount group", sorted(design.linked), groups)),
        plan=fitted_plan(design.plan, usual.plan, vehicle, remarks),
        alterations=Alterations(
            _placements(alterations.placements, vehicle, remarks), alterations.absorbers
        ),
    )


def outside_bounds(design: Design, vehicle: Vehicle) -> tuple[str, ...]:
    """Return a sentence for each rate of a design that is softer or stiffer than its bounds.

    The page takes such rates when they are typed, so that they are none that does not fit.
    """
    return tuple(
        f"{group.name} {spoken(field)} rate: found {rate:g}, which is outside its bounds, {low:g} to "
        f"{high:g} in SI"
        for group in vehicle.mount_groups
        for field in group.fields
        for low, high in [[getattr(end, field) for end in group.bounds]]
        for rate in [getattr(design.rates[group.name], field)]
        if not low <= rate <= high
    )


def _every_rate(
    rates: Rates, groups: Mapping[str, MountGroup], vehicle: Vehicle, remarks: Remarks
) -> Rates:
    """The rates of every group: its own where none are given."""
    remarks.some("mount group", rates, groups)
    for name in groups:
        if name not in rates:
            remarks.say(f"mount group {name!r} came later: it has its own rates")
    return {
        name: _rates(rates[name], group, vehicle, remarks) if name in rates else group.rates
        for name, group in groups.items()
    }


def _rates(rates: MountRates, group: MountGroup, vehicle: Vehicle, remarks: Remarks) -> MountRates:
    """Those of a group, of what it has and as stiff as they can be."""
    where = f"mount group {group.name!r}"
    fitting = {}
    for field, rate in rates.of(RATE_FIELDS).items():
        if field in group.fields:
            most = max(STIFFEST, *_known_rates(vehicle, group, field))
            fitting[field] = remarks.within(f"{where}: {spoken(field)} rate", rate, 0.0, most)
        elif rate:
            remarks.say(f"{where}: {spoken(field)} rate: found {rate:g}, but it is not tuned")
            fitting[field] = getattr(group.rates, field)
    loss = rates.loss_factor
    if loss is not None:
        loss = remarks.within(f"{where}: loss factor", loss, 0.0, max(LARGEST_LOSS, group.loss_factor))
    return group.plain(replace(rates, **fitting, loss_factor=loss))


def _known_rates(vehicle: Vehicle, group: MountGroup, field: str) -> list[float]:
    """What the vehicle's files say of a rate, however large."""
    sets = [rates[group.name] for rates in vehicle.rate_sets.values() if group.name in rates]
    return [getattr(rates, field) for rates in (group.rates, *group.bounds, *sets)]


def _variants(
    variants: Mapping[str, Variant], given: Vehicle, remarks: Remarks
) -> Mapping[str, Variant]:
    """Pinned sets by names that nothing else has, each with a number of its own."""
    if not remarks.few("variants", variants, MOST_VARIANTS):
        variants = dict([*variants.items()][:MOST_VARIANTS])
    own, kept, numbers = known_sets(given), dict[str, Variant](), set[int]()
    for name, variant in variants.items():
        if not remarks.short("variant", name, LONGEST_NAME):
            continue
        called = free_name(name, {**own, **variants} if name in own else own)
        if called != name:
            remarks.say(f"variant {name!r} is called {called!r}: the vehicle has a set of that name")
        number = variant.number
        if number in numbers or not 0 <= number < 2 * MOST_VARIANTS:
            number = next(i for i in range(2 * MOST_VARIANTS) if i not in numbers)
            remarks.say(f"variant {name!r} has another colour: found number {variant.number}")
        numbers.add(number)
        kept[called] = _variant(variant, number, given, remarks)
    return kept


def _variant(variant: Variant, number: int, given: Vehicle, remarks: Remarks) -> Variant:
    """A pinned set with a number, of what the vehicle and the absorbers of the set have."""
    absorbers = fitted_absorbers(variant.absorbers, given, remarks)
    vehicle = with_absorbers(given, absorbers)
    groups = {group.name: group for group in vehicle.mount_groups}
    rates = _every_rate(variant.rates, groups, vehicle, remarks)
    return Variant(rates, number, _placements(variant.placements, vehicle, remarks), absorbers)


def _placements(placements: Placements, vehicle: Vehicle, remarks: Remarks) -> Placements:
    """Where mounts can be."""
    known = remarks.some("mount group", placements, vehicle.rates)
    kept = {}
    for name in known:
        placement = placements[name]
        near = [
            remarks.within(f"place of {name!r}, m", v, -FARTHEST, FARTHEST) for v in placement.offset
        ]
        turned = [remarks.within(f"turn of {name!r}, rad", v, -tau, tau) for v in placement.angles]
        placed = replace(placement, offset=tuple(near), angles=tuple(turned))
        try:
            check_placements(vehicle, {name: placed})
        except ModevizError as error:
            remarks.say(error)
        else:
            kept[name] = placed
    return {name: placed for name, placed in kept.items() if not placed.is_as_given}


def _locked(
    locked: frozenset[tuple[str, str]], groups: Mapping[str, MountGroup], remarks: Remarks
) -> list[tuple[str, str]]:
    kept = []
    for group, field in sorted(locked):
        if remarks.one("mount group", group, groups, usual="") and remarks.one(
            f"rate of {group}", field, groups[group].fields, usual=""
        ):
            kept.append((group, field))
    return kept
