"""The commands and what each may be told."""

import argparse
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import get_args

from modeviz.cli import tables
from modeviz.cli.optimise import optimise_rates
from modeviz.cli.render import render_file
from modeviz.cli.report import write_report
from modeviz.cli.scatter import scatter_mounts
from modeviz.cli.view import view as open_view
from modeviz.dynamics.band import Method
from modeviz.files.rate_settings import ORIGINAL
from modeviz.optimise.run import BUDGET
from modeviz.scatter.tolerance import Tolerance
from modeviz.vehicle.problem import GoalKind

DEFAULT_PORT = 8080
COMMANDS = ("view", "modes", "psd", "wheels", "render", "report", "optimise", "scatter")


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    """What was asked for; its `run` does it."""
    if not arguments or (arguments[0] not in (*COMMANDS, "-h", "--help", "--version")):
        arguments = ["view", *arguments]
    return _parser().parse_args(arguments)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="modeviz",
        description="Modes, ride and mount tuning of a vehicle. Without a command: view.",
    )
    vars(parser)["color"] = False  # by escape sequences, since Python 3.14
    parser.add_argument("--version", action="version", version=f"modeviz {version('modeviz')}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    view = _command(commands, "view", open_view, "open the vehicle in the browser")
    _add_road(view)
    _add_address(view)
    view.add_argument("--dark", action="store_true", help="dark page")

    modes = _command(commands, "modes", tables.modes, "frequencies, damping, names and energies")
    modes.add_argument("--below", type=float, default=25.0, metavar="HZ", help="default 25")
    modes.add_argument(
        "--method",
        choices=get_args(Method),
        default="enriched",
        help="enriched (default), classic: the paper's equation on the original modes, or exact",
    )
    _add_json(modes)

    psd = _command(commands, "psd", tables.psd, "accelerations on a road and their rating")
    _add_road(psd)
    _add_json(psd)

    _add_json(
        _command(commands, "wheels", tables.wheels, "response to unbalance and tyre force variation")
    )
    _add_picture(
        _command(commands, "render", render_file, "write a picture, a loop, a film or an offline page")
    )

    report = _command(
        commands, "report", write_report, "write a comparison of two sets of rates as HTML"
    )
    report.add_argument(
        "--against",
        default=ORIGINAL,
        metavar="NAME|FILE",
        help="the rates that those of --rates are compared with (default: original)",
    )
    _add_road(report)
    report.add_argument(
        "--output", type=Path, default=Path("report.html"), metavar="FILE", help="default report.html"
    )
    report.add_argument(
        "--no-pictures",
        action="store_false",
        dest="pictures",
        help="without the pictures, for which a Chromium is needed",
    )
    _add_search(_command(commands, "optimise", optimise_rates, "search for better mount rates"))
    _add_scatter(
        _command(
            commands, "scatter", scatter_mounts, "drive many vehicles whose mounts are not as drawn"
        )
    )
    return parser


def _command(commands, name: str, run, help_text: str) -> argparse.ArgumentParser:
    command = commands.add_parser(name, help=help_text, description=help_text.capitalize() + ".")
    command.set_defaults(run=run)
    command.add_argument(
        "vehicle", nargs="?", type=Path, metavar="VEHICLE", help="vehicle folder (default: the pickup)"
    )
    command.add_argument(
        "--rates",
        default=ORIGINAL,
        metavar="NAME|FILE",
        help="a set of the vehicle's, such as original or optimised, or a JSON or CSV file",
    )
    command.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="RATE",
        dest="settings",
        help='one rate or loss factor, such as "C2.lateral=131 N/mm" or C2.loss_factor=0.2; may be '
        "repeated",
    )
    return command


def _add_address(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--host",
        default="127.0.0.1",
        help="address to listen on, such as 0.0.0.0 for colleagues (default: this machine)",
    )
    command.add_argument(
        "--port", type=int, default=DEFAULT_PORT, help=f"default {DEFAULT_PORT}; 0 takes a free one"
    )
    command.add_argument(
        "--public-name",
        action="append",
        default=[],
        metavar="NAME",
        dest="public_names",
        help="under which a proxy makes the page known, such as tool.example.com; may be repeated",
    )
    token = command.add_mutually_exclusive_group()
    token.add_argument(
        "--token",
        help="asked of every visitor (default: that of the environment's MODEVIZ_TOKEN, or else a new "
        "one, in the link that is printed); everybody on this machine can read it here",
    )
    token.add_argument("--token-file", type=Path, metavar="FILE", help="that holds the token")
    token.add_argument(
        "--no-token",
        action="store_false",
        dest="has_token",
        help="let in whoever is on this machine",
    )


def _add_road(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--road", metavar="NAME", help="or another random load; default: the vehicle's first road"
    )
    _add_speed(command)


def _add_speed(command: argparse.ArgumentParser) -> None:
    command.add_argument("--speed", metavar="SPEED", help='such as "88 km/h" (default: the vehicle\'s)')


def _add_json(command: argparse.ArgumentParser) -> None:
    command.add_argument("--json", action="store_true", help="print JSON instead of a table")


def _add_search(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--output", type=Path, metavar="FILE", help="where to write what is found: .json or .csv"
    )
    _add_problem(command, "")
    command.add_argument(
        "--goal", metavar="NAME", help="instead of the problem's: " + ", ".join(get_args(GoalKind))
    )
    command.add_argument(
        "--plain",
        action="store_true",
        help="add load cases up as they are, as the paper does, not relative to the original",
    )
    command.add_argument(
        "--starts",
        type=int,
        metavar="N",
        help="the first from --rates; default 20, or 5 for each design of a front",
    )
    command.add_argument(
        "--front",
        metavar="GOALS",
        help='find designs between two goals instead, such as "lateral against vertical"',
    )
    command.add_argument(
        "--global",
        action="store_true",
        dest="everywhere",
        help="search everywhere at once instead: slower, and finds what starts may miss",
    )
    command.add_argument("--seed", type=int, default=0, metavar="N", help="of what is random")
    command.add_argument(
        "--budget",
        type=int,
        default=BUDGET,
        metavar="N",
        help=f"evaluations, besides those that choose where to start; default {BUDGET}",
    )
    command.add_argument(
        "--robust",
        action="store_true",
        help="then make the 95th percentile over mounts within their tolerances small",
    )
    _add_tolerances(command)
    _add_scheduler(command)
    _add_speed(command)
    _add_json(command)


def _add_scatter(command: argparse.ArgumentParser) -> None:
    command.add_argument("--samples", type=int, default=1000, metavar="N", help="default 1000")
    command.add_argument("--seed", type=int, default=0, metavar="N", help="of what is random")
    _add_tolerances(command)
    _add_problem(command, "whose goal; ")
    command.add_argument("--point", metavar="NAME", help="response point; default: the vehicle's first")
    _add_road(command)
    _add_scheduler(command)
    _add_json(command)


def _add_problem(command: argparse.ArgumentParser, what: str) -> None:
    command.add_argument(
        "--problem",
        metavar="NAME|FILE",
        help=f"{what}a .toml file that the page saved is one, too (default: the vehicle's first)",
    )


def _add_tolerances(command: argparse.ArgumentParser) -> None:
    usual = Tolerance()
    command.add_argument(
        "--tolerance",
        type=float,
        metavar="PART",
        help=f"of every mount's hardness, up and down; default {usual.rates:g}",
    )
    command.add_argument(
        "--loss-tolerance",
        type=float,
        metavar="PART",
        help=f"of every mount's loss factor; default {usual.loss_factor:g}",
    )


def _add_scheduler(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="compute on the dask cluster there, as tcp://10.0.0.1:8786 (default: here)",
    )


def _add_picture(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--output",
        type=Path,
        required=True,
        metavar="FILE",
        help="its ending chooses: .png, .gif, .mp4 or .html",
    )
    command.add_argument("--mode", default="", metavar="NAME", help='such as "cab yaw" (default)')
    command.add_argument("--view", choices=("Iso", "Side", "Front", "Top", "Under"), default="Iso")
    command.add_argument(
        "--color",
        choices=("bodies", "displacement", "kinetic energy", "strain energy"),
        default="bodies",
        help="what the colours of the bodies mean",
    )
    command.add_argument(
        "--background",
        choices=("scene", "white", "transparent"),
        default="scene",
        help="as on screen (default), or another; loops and films are never transparent, but white",
    )
    command.add_argument("--dark", action="store_true", help="the dark scene")
    command.add_argument("--width", type=int, default=1280, help="pixels, default 1280")
    command.add_argument("--height", type=int, default=720, help="pixels, default 720")
    command.add_argument("--amplitude", type=float, default=1.0, help="times the usual one")
    command.add_argument(
        "--phase", type=float, default=0.0, metavar="DEGREES", help="of a PNG (default 0: the largest)"
    )
    command.add_argument(
        "--frames", type=int, default=36, help="of a cycle in a GIF or MP4, default 36"
    )
    _add_road(command)
