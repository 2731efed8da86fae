"""The command that tells the tokens that are kept for links, and revokes them."""

from argparse import ArgumentParser
from dataclasses import dataclass
from pathlib import Path

from modeviz.cli.command import Command
from modeviz.cli.interrupt import ended_by_interrupt
from modeviz.cli.results import check_printable, print_result
from modeviz.errors import ModevizError

DAY_S = 86400.0


@dataclass(frozen=True, kw_only=True)
class TokenOptions:
    """What `modeviz token` is asked for."""

    what: tuple[Path, ...] = ()
    """A vehicle folder, or files; none: all whose tokens are kept."""
    revoke: bool = False
    """Whether there is to be another."""


def token(options: TokenOptions) -> None:
    """Prints the tokens, what each opens, and for how long still; new ones, if the old are revoked.

    Raises:
        ModevizError: none is kept, or it cannot be replaced.
    """
    with ended_by_interrupt():
        from modeviz.viewer.page.doors.kept_tokens import LIFE_S, KeptToken, kept_token, kept_tokens

    def line(kept: KeptToken) -> str:
        days = max(LIFE_S - kept.age(), 0.0) / DAY_S
        return f"{kept.held()}  {days:.0f} days  {', '.join(kept.opens)}"

    check_printable()
    wanted = kept_token(options.what).path if options.what else None
    found = [kept for kept in kept_tokens() if wanted in (None, kept.path)]
    if not found:
        raise ModevizError("no token is kept of that: `modeviz view` makes one when it starts")
    try:
        for kept in found if options.revoke else ():
            kept.replace()
        print_result("\n".join(map(line, found)))
    except OSError as error:
        raise ModevizError(f"the token cannot be kept: {error.filename}: {error.strerror}") from None


def _add_options(command: ArgumentParser) -> None:
    command.add_argument(
        "what",
        nargs="*",
        type=Path,
        metavar="VEHICLE|FILE",
        help="as of `view` (default: all there are)",
    )
    command.add_argument(
        "--revoke",
        action="store_true",
        help="make new ones: old links and cookies are refused, and open pages thrown out",
    )


TOKEN = Command(
    "token", "tell the tokens that open pages, or revoke them", TokenOptions, _add_options, token
)
