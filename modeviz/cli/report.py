"""The command that writes a comparison of two sets of rates as an HTML file."""

from argparse import Namespace
from collections.abc import Sequence
from datetime import date
from pathlib import Path

from modeviz.analysis.exact_check import Check, checked
from modeviz.analysis.results import Conditions
from modeviz.cli.interrupt import ended_by_interrupt
from modeviz.cli.options import prepare_telling, ride, vehicle_and_rates
from modeviz.cli.terminal import Teller, progress, say
from modeviz.errors import ModevizError
from modeviz.files.disk import check_writable, write_text
from modeviz.files.rate_settings import resolve_rates
from modeviz.report.comparison import Comparison, RateSet, compare
from modeviz.report.html import Picture, report
from modeviz.vehicle.vehicle import Vehicle

PICTURE_SIZE = (1280, 800)
"""Pixels."""


def write_report(options: Namespace) -> None:
    """Solves with both sets of rates, checks the answer and writes the report."""
    vehicle, rates = vehicle_and_rates(options)
    base = RateSet(_name(options.against), resolve_rates(vehicle, options.against))
    now = RateSet(_name(options.rates, bool(options.settings)), rates)
    chosen = ride(options, vehicle)
    check_writable(options.output)
    pictures = _pictures(vehicle, (base, now), chosen) if options.pictures else []
    comparison = compare(prepare_telling(vehicle), base, now, chosen)
    page = report(comparison, date.today(), pictures, _check(comparison))
    write_text(options.output, page)
    print(f"{options.output}: {now.name} against {base.name}")


def _pictures(
    vehicle: Vehicle, sets: Sequence[RateSet], conditions: Conditions | None
) -> list[Picture]:
    """The mode the page would open with, with both sets of rates; none of a vehicle without a road."""
    if conditions is None:
        return []
    with ended_by_interrupt():
        from modeviz.viewer.pictures.pictures import (
            ImageSettings,  # viser alone takes a second to import
        )
        from modeviz.viewer.rendering import RenderRequest, photographs
        from modeviz.viewer.scene.stage import FIELD_OF_VIEW, ISO, LIGHT

    wish = RenderRequest("", ISO, "bodies", amplitude=1.0, phase=0.0, n_frames=1)
    shot = ImageSettings(*PICTURE_SIZE, "white", LIGHT, FIELD_OF_VIEW)
    try:
        return photographs(vehicle, sets, conditions, wish, shot, Teller())
    except ModevizError as error:
        raise ModevizError(f"{error}; or leave the pictures out with --no-pictures") from error
    finally:
        say("")


def _name(choice: str, is_changed: bool = False) -> str:
    """What a set of rates is called: short, for it stands above columns; the rates tell the rest."""
    return f"{Path(choice).name}, changed" if is_changed else Path(choice).name


def _check(comparison: Comparison) -> Check | None:
    """The second set of rates against the full model, solved from scratch; None without a road."""
    if comparison.rides is None:
        return None
    tell = progress("checking")
    found = checked(comparison.rides[1], tell)
    tell(1.0)
    return found
