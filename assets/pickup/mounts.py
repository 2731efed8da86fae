"""The mounts that are tuned, with the rates of the paper's Table 4."""

import numpy as np

from modeviz.units import factor
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from pickup.parameters import Parameters
from pickup.sides import SIDES, Place, on_side


def _table_4(vertical: float, lateral: float, fore_aft: float) -> MountRates:
    n_per_cm = factor("N/cm", "stiffness")
    return MountRates(vertical * n_per_cm, lateral * n_per_cm, fore_aft * n_per_cm)


ORIGINAL = {
    "F": _table_4(5510, 1700, 3500),
    "C1": _table_4(10940, 6700, 4200),
    "C2": _table_4(7240, 2940, 2940),
    "E": _table_4(14000, 4400, 3000),
    "T": _table_4(4760, 2850, 6220),
}
OPTIMISED = {
    "F": _table_4(5270, 1290, 1300),
    "C1": _table_4(21000, 16600, 5360),
    "C2": _table_4(5210, 1310, 1410),
    "E": _table_4(17600, 5180, 3610),
    "T": _table_4(5050, 2840, 6390),
}

SOFTEST, STIFFEST = 0.25, 3.0
"""Bounds of every rate, of the original one; the paper does not give its own."""

SHEAR_RATIOS = (0.25, 0.80)
"""What lateral and fore-aft rates of the paper's body mounts may be of the vertical one."""


def mount_groups(p: Parameters) -> tuple[MountGroup, ...]:
    """The five groups at their original rates."""
    body, powertrain = p.body_mount_loss_factor, p.engine_mount_loss_factor
    return (
        _group("F", "front end", body, SHEAR_RATIOS, _pair("F", "front end", p.front_end_mount)),
        _group("C1", "cab front", body, SHEAR_RATIOS, _pair("C1", "cab", p.cab_front_mount)),
        _group("C2", "cab rear", body, SHEAR_RATIOS, _pair("C2", "cab", p.cab_rear_mount)),
        _group("E", "engine", powertrain, None, _pair("E", "engine", p.engine_mount)),
        _group("T", "transmission", powertrain, None, (_mount("T", "engine", p.transmission_mount),)),
    )


def _group(
    name: str,
    label: str,
    loss_factor: float,
    ratio_limits: tuple[float, float] | None,
    mounts: tuple[Mount, ...],
) -> MountGroup:
    rates = ORIGINAL[name]
    bounds = _scaled(rates, SOFTEST), _scaled(rates, STIFFEST)
    return MountGroup(name, label, rates, loss_factor, bounds, mounts, ratio_limits)


def _pair(group: str, body: str, right: Place) -> tuple[Mount, ...]:
    return tuple(_mount(f"{group} {side}", body, on_side(right, side)) for side in SIDES)


def _mount(name: str, body: str, position: Place) -> Mount:
    return Mount(name, group="", bodies=(body, "frame"), points=np.array([position, position]))


def _scaled(rates: MountRates, by: float) -> MountRates:
    return MountRates(*(by * rate for rate in rates.as_tuple()))
