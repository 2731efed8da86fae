"""The commands put together, and what is typed to choose and to ask one."""

import argparse
from collections.abc import Callable, Sequence
from functools import partial
from importlib.metadata import version

from modeviz.cli.check import CHECK
from modeviz.cli.command import Command
from modeviz.cli.export import EXPORT
from modeviz.cli.importing import IMPORT
from modeviz.cli.modes import MODES
from modeviz.cli.optimise import OPTIMISE
from modeviz.cli.psd import PSD
from modeviz.cli.render import RENDER
from modeviz.cli.report import REPORT
from modeviz.cli.scatter import SCATTER
from modeviz.cli.view import VIEW
from modeviz.cli.wheels import WHEELS

COMMANDS = (VIEW, MODES, PSD, WHEELS, RENDER, REPORT, OPTIMISE, SCATTER, IMPORT, CHECK, EXPORT)


def parse(arguments: Sequence[str]) -> Callable[[], None]:
    """Return what does that which was asked for; what no command understands ends the program."""
    names = {command.name for command in COMMANDS}
    if not arguments or (arguments[0] not in (*names, "-h", "--help", "--version")):
        arguments = [VIEW.name, *arguments]
    given = _parser().parse_args(arguments)
    command: Command = given.command
    return partial(command.run, command.asked(given))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="modeviz",
        description="Modes, ride and mount tuning of a vehicle. Without a command: view.",
    )
    vars(parser)["color"] = False  # by escape sequences, since Python 3.14
    parser.add_argument("--version", action="version", version=f"modeviz {version('modeviz')}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    for command in COMMANDS:
        own = commands.add_parser(
            command.name,
            help=command.help,
            description=command.help.capitalize() + ".",
            argument_default=argparse.SUPPRESS,  # what is not given is as the command's options say
        )
        own.set_defaults(command=command)
        command.add_options(own)
    return parser
