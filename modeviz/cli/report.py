"""The command that writes a comparison of two sets of rates as an HTML file."""

from argparse import ArgumentParser
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from modeviz.analysis.results import Conditions
from modeviz.cli.command import Command, of_options
from modeviz.cli.interrupt import ended_by_interrupt
from modeviz.cli.options import RoadOptions, VehicleOptions, add_road, add_vehicle, prepare_telling
from modeviz.cli.studies.options import add_session, file_of, session_of
from modeviz.cli.terminal import Teller, say
from modeviz.errors import ModevizError
from modeviz.files.disk import check_writable
from modeviz.files.rate_settings import ORIGINAL, resolve_rates
from modeviz.journal.records import Records
from modeviz.report.comparison import RateSet
from modeviz.report.html import Picture
from modeviz.report.notes import Note
from modeviz.study.pictures import report_pictures
from modeviz.study.reporting import write_report
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, kw_only=True)
class ReportOptions(VehicleOptions, RoadOptions):
    """What `modeviz report` is asked for."""

    against: str = ORIGINAL
    """The name of a set of the vehicle's, or of a file."""
    output: Path = Path("report.html")
    pictures: bool = True
    """Whether it has some."""
    notes: Path | None = None
    """The file of a study whose notes are told, or the folder of its vehicle."""
    session: int | None = None
    """Whose notes; None: those of all sessions."""

    def remarks(self) -> tuple[Note, ...]:
        """Return the notes; raises ModevizError if there is no such study or session."""
        if self.notes is None:
            if self.session is not None:
                raise ModevizError("--session is of a study, which --notes names")
            return ()
        records = Records.of_file(file_of(self.notes))
        with of_options():
            return records.notes(session_of(records, self.session))


def compare_rates(options: ReportOptions) -> None:
    """Solves with both sets of rates, checks the answer and writes the report."""
    given = options.given()
    vehicle, rates = options.with_rates(given)
    base = RateSet(_name(options.against), resolve_rates(given, options.against))
    is_changed = bool(options.settings or options.places)
    now = RateSet(_name(options.rates, is_changed), rates, options.placements)
    conditions = options.ride(vehicle)
    check_writable(options.output)
    remarks = options.remarks()
    pictures = []
    if options.pictures and conditions is not None:
        pictures = _pictures(given, (base, now), conditions)
    vehicles = (given, vehicle) if options.places else (vehicle,)
    prepare = [partial(prepare_telling, each) for each in vehicles]
    write_report(options.output, prepare, (base, now), conditions, pictures, Teller(), remarks)
    print(f"{options.output}: {now.name} against {base.name}")


def _pictures(vehicle: Vehicle, sets: tuple[RateSet, RateSet], conditions: Conditions) -> list[Picture]:
    """The mode the page would open with, with both sets of rates."""
    with ended_by_interrupt():
        import modeviz.viewer.rendering  # noqa: F401  viser alone takes a second

    try:
        return report_pictures(vehicle, sets, conditions, Teller())
    except ModevizError as error:
        raise ModevizError(f"{error}; or leave the pictures out with --no-pictures") from error
    finally:
        say("")


def _name(choice: str, is_changed: bool = False) -> str:
    """Return a short name of a set of rates, for it stands above columns; the rates tell the rest."""
    return f"{Path(choice).name}, changed" if is_changed else Path(choice).name


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    command.add_argument(
        "--against",
        metavar="NAME|FILE",
        help="the rates that those of --rates are compared with (default: original)",
    )
    add_road(command)
    command.add_argument("--output", type=Path, metavar="FILE", help="default report.html")
    command.add_argument(
        "--no-pictures",
        action="store_false",
        dest="pictures",
        help="without the pictures, for which a Chromium is needed",
    )
    command.add_argument(
        "--notes",
        type=Path,
        metavar="STUDY",
        help="with the notes of a study: its file, or the folder of its vehicle",
    )
    add_session(command)


REPORT = Command(
    "report",
    "write a comparison of two sets of rates as HTML",
    ReportOptions,
    _add_options,
    compare_rates,
)
