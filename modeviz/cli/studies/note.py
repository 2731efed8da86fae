"""The command that writes a note into a study."""

import getpass
from argparse import ArgumentParser
from dataclasses import dataclass

from modeviz.cli.command import Command, of_options
from modeviz.cli.studies.options import StudyOptions, add_session, add_study, session_of
from modeviz.errors import ModevizError, unknown
from modeviz.journal.note_beside import write_beside
from modeviz.journal.records import Records
from modeviz.report.notes import Note, PinnedTo


@dataclass(frozen=True, kw_only=True)
class NoteOptions(StudyOptions):
    """What `modeviz study note` is asked for."""

    text: str
    variant: str | None = None
    mode: str | None = None
    mount: str | None = None
    """What it is pinned to, at most one."""
    session: int | None = None
    """Whose note it is; None: a note for all."""
    author: str | None = None
    """None: the user of this machine."""

    @property
    def pinned_to(self) -> tuple[PinnedTo, str]:
        """To what it is pinned, and the name of that."""
        kinds: tuple[PinnedTo, ...] = ("variant", "mode", "mount")
        for kind in kinds:
            if (name := getattr(self, kind)) is not None:
                return kind, name
        return "study", ""


def write_note(options: NoteOptions) -> None:
    """Writes the note, also while the study is used, and prints where it is.

    Raises:
        ModevizError: there is no such study, session or variant, or it cannot be written.
    """
    records = options.read()
    with of_options():
        session = session_of(records, options.session)
        if options.variant is not None:
            _check_variant(records, options.variant)
    note = Note(options.text, *options.pinned_to, author=options.author or _user())
    write_beside(records.path, session, note)
    print(f"{records.path}: note on {note.about}")


def _check_variant(records: Records, name: str) -> None:
    known = {variant for line in records.sessions() for variant in line.variants}
    if name not in known:
        raise ModevizError(f"variant: {unknown('variant', name, sorted(known))}")


def _user() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):  # nobody has a name here
        return ""


def _add_options(command: ArgumentParser) -> None:
    add_study(command, is_needed=True)
    command.add_argument("text", metavar="TEXT", help="what it says")
    pinned = command.add_mutually_exclusive_group()
    pinned.add_argument("--variant", metavar="NAME", help="pinned to it")
    pinned.add_argument("--mode", metavar="NAME", help='pinned to it, such as "cab yaw"')
    pinned.add_argument("--mount", metavar="NAME", help="pinned to it, or to a group")
    add_session(command)
    command.add_argument("--author", metavar="NAME", help="default: the user of this machine")


NOTE = Command(
    "note", "write a note into a study, also while it is used", NoteOptions, _add_options, write_note
)
