"""The commands that print: `modes`, `psd` and `wheels`, as tables or JSON."""

import math
from argparse import Namespace

from modeviz.analysis.following import solve_followed
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.results import solve, solve_wheels
from modeviz.cli.options import (
    conditions,
    prepare_telling,
    vehicle_and_rates,
)
from modeviz.cli.results import check_printable, print_result
from modeviz.errors import ModevizError
from modeviz.report.records import modes_record, psd_record, wheels_record
from modeviz.report.tables import modes_table, psd_table, wheels_table
from modeviz.study.conditions import need


def modes(options: Namespace) -> None:
    """Prints natural frequencies, damping, names and energies."""
    check_printable()
    if not (options.below > 0 and math.isfinite(options.below)):
        raise ModevizError(f"--below: found {options.below:g} Hz, expected more than zero")
    vehicle, rates = vehicle_and_rates(options)
    prepared = prepare_modes(vehicle, max(options.below or 0, vehicle.highest_frequency))
    followed = solve_followed(prepared, rates, options.method)
    print_result((modes_record if options.json else modes_table)(followed, options.below))


def psd(options: Namespace) -> None:
    """Prints accelerations on a road and their rating."""
    check_printable()
    vehicle, rates = vehicle_and_rates(options)
    chosen = conditions(options, vehicle)
    results = solve(prepare_telling(vehicle), rates, chosen)
    print_result((psd_record if options.json else psd_table)(results))


def wheels(options: Namespace) -> None:
    """Prints the response to every wheel load."""
    check_printable()
    vehicle, rates = vehicle_and_rates(options)
    need(vehicle, "response point", vehicle.response_points)
    need(vehicle, "wheel load", vehicle.harmonic_loads)
    results = solve_wheels(prepare_telling(vehicle), rates)
    tuned = vehicle.with_rates(rates)
    print_result((wheels_record if options.json else wheels_table)(tuned, results))
