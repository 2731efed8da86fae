"""Mount rates as people name them: "C2.lateral=131 N/mm", a set's name, or a file."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from modeviz.errors import VehicleError, listed, located, quoted, unknown
from modeviz.files.rate_files import read_rates
from modeviz.files.records.rates import RateSetRecord
from modeviz.files.schema.quantities import quantity_of
from modeviz.units import parse, parse_number
from modeviz.vehicle.mount_rates import RATE_FIELDS, RATE_NAMES, Rates
from modeviz.vehicle.vehicle import Vehicle

ORIGINAL = "original"
"""The choice of the rates that the vehicle has."""

LOSS_FACTOR = "loss_factor"
"""The field of `MountRates` that is no rate."""


def parse_setting(text: str, rates: Rates) -> Rates:
    """The rates of the group that a setting such as "C2.lateral=131 N/mm" changes.

    Args:
        text: that, or "C2.loss_factor=0.2".
        rates: of every group, before the change.

    Raises:
        VehicleError: not of that form, or a group, direction or unit that does not exist.
    """
    name, _, value = text.partition("=")
    with located(f"setting {quoted(text)}"):
        if "." not in name or not value:
            raise VehicleError(
                "expected GROUP.DIRECTION=RATE UNIT, as in C2.lateral=131 N/mm, or "
                "GROUP.loss_factor=NUMBER"
            )
        group, field = rate_field(name, rates)
        quantity = quantity_of(RateSetRecord, field)
        number = parse(value, quantity) if quantity else parse_number(value)
        return {group: replace(rates[group], **{field: number})}


def rate_field(name: str, rates: Rates) -> tuple[str, str]:
    """Return the group and the field of `MountRates` that a name such as "C2.fore-aft" means.

    Args:
        name: that, or "C2.loss_factor".
        rates: of every group.

    Raises:
        VehicleError: not of that form, or a group or direction that does not exist.
    """
    group, dot, key = name.strip().rpartition(".")
    if not dot:
        raise VehicleError(
            "expected GROUP.DIRECTION or GROUP.loss_factor, as in C2.lateral; there are the groups "
            + listed(rates)
        )
    if group not in rates:
        raise VehicleError(unknown("mount group", group, rates))
    field = key.replace("-", "_")
    if field not in (*RATE_FIELDS, LOSS_FACTOR):
        raise VehicleError(unknown("direction", key, (*RATE_NAMES.values(), LOSS_FACTOR)))
    return group, field


def resolve_rates(vehicle: Vehicle, choice: str, settings: Iterable[str] = ()) -> Rates:
    """The rates of every group of a vehicle: those chosen, changed by one setting after the other.

    Args:
        vehicle: whose groups and named sets there are to choose from.
        choice: "original", the name of one of the vehicle's sets, or a file's.
        settings: as for `parse_setting`.

    Raises:
        VehicleError: no such choice, or a setting or file that is wrong.
    """
    rates = {**vehicle.rates, **_chosen(vehicle, choice)}
    for setting in settings:
        rates |= parse_setting(setting, rates)
    return vehicle.all_rates(rates)


def _chosen(vehicle: Vehicle, choice: str) -> Rates:
    if choice == ORIGINAL:
        return vehicle.rates
    if choice in vehicle.rate_sets:
        return vehicle.rate_sets[choice]
    if Path(choice).suffix:
        return read_rates(Path(choice), vehicle)
    known = unknown("rates", choice, dict.fromkeys((ORIGINAL, *vehicle.rate_sets)))
    raise VehicleError(f"{known}, or give a .json or .csv file")
