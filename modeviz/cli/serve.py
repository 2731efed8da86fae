"""The command that serves several vehicles behind one address, with a start page."""

from argparse import ArgumentParser
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from modeviz.cli.command import Command
from modeviz.cli.interrupt import ended_by_interrupt, stopped_by_signal
from modeviz.cli.logs import logged
from modeviz.cli.options import RoadOptions
from modeviz.cli.server import ServerOptions, add_server
from modeviz.cli.studies.kept import kept_study
from modeviz.cli.terminal import remark
from modeviz.errors import ModevizError
from modeviz.files import read_vehicle
from modeviz.journal.places import study_path

if TYPE_CHECKING:
    from modeviz.viewer.serving.bench import Bench


@dataclass(frozen=True, kw_only=True)
class ServeOptions(ServerOptions):
    """What `modeviz serve` is asked for."""

    folders: tuple[Path, ...] = ()
    """Of the vehicles."""
    is_forgetful: bool = False
    """Whether sessions end with the server, and not in a file beside each vehicle."""


def serve_folders(options: ServeOptions) -> None:
    """Serves vehicles until it is stopped."""
    with ended_by_interrupt():
        from modeviz.viewer.page.doors.secret import chosen_secret
        from modeviz.viewer.page.doors.surroundings import surroundings
        from modeviz.viewer.serving.serve import serve  # viser alone takes a second to import

    folders = options.folders
    token = chosen_secret(options.token, options.token_file, options.has_token, folders, remark)
    around = surroundings(options.public_names, options.frames, options.proxies, options.path_prefix)
    with logged(options), ExitStack() as ending:
        benches = {
            name: _bench(folder, options.is_forgetful, ending)
            for name, folder in named_folders(folders).items()
        }
        stop = ending.enter_context(stopped_by_signal())
        door = options.host, options.port, token, options.dark
        serve(benches, *door, around=around, stop=stop, is_lazy=True)


def named_folders(folders: Sequence[Path]) -> dict[str, Path]:
    """Return folders by names of their own, as addresses call them.

    Raises:
        ModevizError: one is there twice.
    """
    named: dict[str, Path] = {}
    for folder in folders:
        path = folder.resolve()
        if path in (known.resolve() for known in named.values()):
            raise ModevizError(f"{folder} is there twice: name each vehicle's folder once")
        names = (path.name if i == 1 else f"{path.name}-{i}" for i in count(1))
        named[next(name for name in names if name not in named)] = folder
    return named


def _bench(folder: Path, is_forgetful: bool, ending: ExitStack) -> "Bench":
    """Return the bench of a folder's vehicle, which is read and not made ready yet.

    Raises:
        ModevizError: it is no whole vehicle, or its study is in use or damaged.
    """
    from modeviz.viewer.serving.bench import Bench

    own = read_vehicle(folder)
    if not own.all_connections:
        raise ModevizError(f"{folder}: its bodies are not mounted yet; look at them with modeviz view")
    vehicle, conditions = RoadOptions().shown(own)
    study = None
    if not is_forgetful:
        study = ending.enter_context(kept_study(study_path(folder), vehicle))
    return Bench(vehicle, vehicle.rates, conditions, study=study)


def _add_options(command: ArgumentParser) -> None:
    command.add_argument(
        "folders", nargs="+", type=Path, metavar="FOLDER", help="a vehicle folder; may be repeated"
    )
    add_server(command)
    command.add_argument(
        "--no-study",
        action="store_true",
        dest="is_forgetful",
        help="forget sessions when the server ends",
    )


SERVE = Command(
    "serve",
    "open several vehicles behind one address, with a start page",
    ServeOptions,
    _add_options,
    serve_folders,
)
