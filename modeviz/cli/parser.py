"""The commands put together, and what is typed to choose and to ask one."""

import argparse
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from difflib import get_close_matches
from functools import partial
from importlib.metadata import version
from itertools import takewhile
from pathlib import Path
from typing import Any

from modeviz.cli.check import CHECK
from modeviz.cli.command import Command, CommandGroup
from modeviz.cli.engine import ENGINE
from modeviz.cli.export import EXPORT
from modeviz.cli.forces import FORCES
from modeviz.cli.importing.command import IMPORT
from modeviz.cli.modes import MODES
from modeviz.cli.new import NEW
from modeviz.cli.optimise import OPTIMISE
from modeviz.cli.paths import PATHS
from modeviz.cli.psd import PSD
from modeviz.cli.render import RENDER
from modeviz.cli.report import REPORT
from modeviz.cli.rigid import RIGID
from modeviz.cli.scatter import SCATTER
from modeviz.cli.serve import SERVE
from modeviz.cli.static import STATIC
from modeviz.cli.studies.study import STUDY
from modeviz.cli.token import TOKEN
from modeviz.cli.view import VIEW
from modeviz.cli.wheels import WHEELS
from modeviz.errors import ModevizError, unknown

COMMANDS = (
    VIEW,
    SERVE,
    TOKEN,
    NEW,
    MODES,
    RIGID,
    PSD,
    WHEELS,
    ENGINE,
    FORCES,
    PATHS,
    STATIC,
    RENDER,
    REPORT,
    OPTIMISE,
    SCATTER,
    IMPORT,
    CHECK,
    EXPORT,
    STUDY,
)


OPTION = re.compile(r"--[\w-]+")


def parse(arguments: Sequence[str]) -> Callable[[], None]:
    """Return what does that which was asked for; what no command understands ends the program.

    Raises:
        ModevizError: there is no such command or option; the text says which may be meant.
    """
    names = [command.name for command in COMMANDS]
    if not arguments or (arguments[0] not in (*names, "-h", "--help", "--version")):
        _check_no_command(arguments[:1], names)
        arguments = [VIEW.name, *arguments]
    parser, of_commands = _parsers()
    _check_in_group(arguments, of_commands)
    for n_words in (1, 2):
        if own := of_commands.get(tuple(arguments[:n_words])):
            _check_options(arguments[n_words:], own)
    given = parser.parse_args(arguments)
    command: Command = given.command
    return partial(command.run, command.asked(given))


def _check_no_command(first: Sequence[str], names: Sequence[str]) -> None:
    """Raises ModevizError if what ought to be a folder or a file is likely a command misspelt."""
    for word in first:
        if word.isalpha() and get_close_matches(word.lower(), names, n=1) and not Path(word).exists():
            raise ModevizError(unknown("command", word, names))


def _check_in_group(arguments: Sequence[str], of_commands: Iterable[tuple[str, ...]]) -> None:
    """Raises ModevizError for a command that a group does not have."""
    inner = [words[1] for words in of_commands if words[:-1] == tuple(arguments[:1])]
    for word in arguments[1:2] if inner else ():
        if not word.startswith("-") and word not in inner:
            raise ModevizError(unknown(f"command of {arguments[0]}", word, inner))


def _check_options(arguments: Sequence[str], own: argparse.ArgumentParser) -> None:
    """Raises ModevizError for an option that a command does not have."""
    known = ["--help", *OPTION.findall(own.format_usage())]
    for word in takewhile(lambda word: word != "--", arguments):
        name = word.partition("=")[0]
        if OPTION.fullmatch(name) and name not in known:
            raise ModevizError(f"{own.prog}: {unknown('option', name, known)}")


def _parsers() -> tuple[argparse.ArgumentParser, Mapping[tuple[str, ...], argparse.ArgumentParser]]:
    """The program's parser, and those of its commands by the words that choose them."""
    parser = argparse.ArgumentParser(
        prog="modeviz",
        description="Modes, ride and mount tuning of a vehicle. Without a command: view.",
        allow_abbrev=False,
    )
    vars(parser)["color"] = False  # by escape sequences, since Python 3.14
    parser.add_argument("--version", action="version", version=f"modeviz {version('modeviz')}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    found: dict[tuple[str, ...], argparse.ArgumentParser] = {}
    for command in COMMANDS:
        if isinstance(command, Command):
            found[(command.name,)] = _add(commands, command)
            continue
        inner = _parser_of(commands, command).add_subparsers(required=True, metavar="COMMAND")
        found |= {(command.name, each.name): _add(inner, each) for each in command.commands}
    return parser, found


def _add(commands: Any, command: Command[Any]) -> argparse.ArgumentParser:
    """Adds the parser of a command, and returns it."""
    own = _parser_of(commands, command)
    own.set_defaults(command=command)
    command.add_options(own)
    return own


def _parser_of(commands: Any, command: Command[Any] | CommandGroup) -> argparse.ArgumentParser:
    return commands.add_parser(
        command.name,
        help=command.help,
        description=command.help.capitalize() + ".",
        argument_default=argparse.SUPPRESS,  # what is not given is as the command's options say
        allow_abbrev=False,
    )
