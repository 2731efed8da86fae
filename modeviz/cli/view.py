"""The command that opens a vehicle, or files of another program, in the browser."""

from argparse import ArgumentParser
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from modeviz.cli.command import Command
from modeviz.cli.interrupt import ended_by_interrupt, stopped_by_signal
from modeviz.cli.logs import logged
from modeviz.cli.options import RoadOptions, VehicleOptions, add_rates, add_road
from modeviz.cli.server import ServerOptions, add_server
from modeviz.cli.studies.kept import kept_study
from modeviz.cli.terminal import progress, remark
from modeviz.errors import ModevizError
from modeviz.files import builtin_vehicle
from modeviz.formats.mounts.imported import check_no_mounts
from modeviz.formats.reading import are_results, check_are_read
from modeviz.journal.places import study_path


@dataclass(frozen=True, kw_only=True)
class ViewOptions(VehicleOptions, RoadOptions, ServerOptions):
    """What `modeviz view` is asked for."""

    what: tuple[Path, ...] = ()
    """A vehicle folder, or the files of one component; none: the pickup."""
    state: str | None = None
    """A link to a view, or what stands in one behind "view="."""

    study: Path | None = None
    """The file that remembers sessions; None: beside the vehicle."""
    is_forgetful: bool = False
    """Whether no file does."""
    bodies: bool = False
    """Whether bodies are looked at one by one though they make a vehicle."""

    def of_folder(self) -> "ViewOptions":
        """Return the options with the vehicle folder that is asked for.

        Raises:
            ModevizError: there are several.
        """
        if len(self.what) > 1:
            names = ", ".join(map(str, self.what))
            raise ModevizError(f"found {names}, expected one vehicle folder, or files of one component")
        return replace(self, vehicle=self.what[0]) if self.what else self

    def check_no_vehicle(self) -> None:
        """Raises ModevizError if something is asked for that only a vehicle has."""
        for option in ("rates", "settings", "places", "road", "speed", "state"):
            if getattr(self, option) != getattr(ViewOptions, option):
                name = {"settings": "set", "places": "place"}.get(option, option)
                raise ModevizError(f"--{name} is of a vehicle, and a component's files are given")


def view(options: ViewOptions) -> None:
    """Serves the page until it is stopped."""
    with ended_by_interrupt():
        from modeviz.viewer.inspection.app import inspect
        from modeviz.viewer.inspection.sources import (
            ResultFiles,
            Source,
            VehicleFolder,
            finished_vehicle,
        )
        from modeviz.viewer.page.doors.secret import chosen_secret
        from modeviz.viewer.page.doors.surroundings import surroundings
        from modeviz.viewer.serving.bench import Bench
        from modeviz.viewer.serving.serve import serve  # viser alone takes a second to import
        from modeviz.viewer.session.encoding.link import view_in

    what = options.what or (options.vehicle or builtin_vehicle(),)
    token = chosen_secret(options.token, options.token_file, options.has_token, what, remark)
    around = surroundings(options.public_names, options.frames, options.proxies, options.path_prefix)
    door = (options.host, options.port, token, options.dark)

    def look_at(source: Source) -> None:
        with logged(options), stopped_by_signal() as stop:
            inspect(source, *door, around, remark, stop)

    check_no_mounts(options.what)
    if are_results(options.what):
        options.check_no_vehicle()
        look_at(ResultFiles(options.what))
        return
    check_are_read(options.what)
    options = options.of_folder()
    folder = options.vehicle or builtin_vehicle()
    vehicle = None if options.bodies else finished_vehicle(folder)
    if vehicle is None:
        look_at(VehicleFolder(folder, is_ours=options.vehicle is None))
        return
    vehicle, start = options.with_rates(vehicle)
    vehicle, chosen = options.shown(vehicle)
    link = None if options.state is None else view_in(options.state)
    with logged(options), ExitStack() as ending:
        study = None
        if not options.is_forgetful:
            path = options.study or study_path(folder, is_ours=options.vehicle is None)
            study = ending.enter_context(kept_study(path, vehicle))
        bench = Bench(vehicle, start, chosen, link, study)
        stop = ending.enter_context(stopped_by_signal())
        serve({vehicle.name: bench}, *door, progress("preparing"), around, stop)


def _add_options(command: ArgumentParser) -> None:
    command.add_argument(
        "what",
        nargs="*",
        type=Path,
        metavar="VEHICLE|FILE",
        help="a vehicle folder (default: the pickup), or a component's files of another program",
    )
    add_rates(command)
    add_road(command)
    add_server(command)
    command.add_argument(
        "--state",
        metavar="LINK",
        help="what is shown first: a link that was copied on the page, or what it has behind view=",
    )
    study = command.add_mutually_exclusive_group()
    study.add_argument(
        "--study",
        type=Path,
        metavar="FILE",
        help="that remembers sessions, changes and variants (default: beside the vehicle folder)",
    )
    study.add_argument(
        "--no-study",
        action="store_true",
        dest="is_forgetful",
        help="forget sessions when the server ends",
    )
    command.add_argument(
        "--bodies",
        action="store_true",
        help="look at bodies one by one, in their own modes, and take files of others to import",
    )


VIEW = Command("view", "open the vehicle in the browser", ViewOptions, _add_options, view)
