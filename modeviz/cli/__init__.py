"""The command line.

`modeviz [view|modes|psd|wheels|render|report|optimise|scatter|check] [VEHICLE]`, `modeviz import FILE`,
`modeviz serve FOLDER...`, `modeviz export [VEHICLE] FILE`, `modeviz new KIND FOLDER`.
"""

import sys
from collections.abc import Sequence

from modeviz.cli.interrupt import ended_by_interrupt, interrupted
from modeviz.cli.streams import one_line, printed_plainly
from modeviz.errors import ModevizError


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a command and returns its exit status.

    That is 0, or 2 for what the user can put right, or 130 after an interrupt.
    """
    with printed_plainly():
        try:
            _run(sys.argv[1:] if arguments is None else arguments)
        except ModevizError as error:
            print("modeviz:", one_line(str(error)), file=sys.stderr)
            return 2
        except KeyboardInterrupt:
            return interrupted()
    return 0


def _run(arguments: Sequence[str]) -> None:
    with ended_by_interrupt():  # they take a second
        from modeviz.cli.parser import parse
        from modeviz.compute.threads import one_thread

    run = parse(arguments)
    with one_thread():
        run()
    sys.stdout.flush()
