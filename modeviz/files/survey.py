"""All that can be read of a vehicle folder with mistakes in it, and every mistake.

The reader of folders says what is wrong and stops. Here that is taken out of the tables and they are
read again, until nothing is wrong with what is left: no second reader has to know what is right.
"""

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from modeviz.errors import Fault, FaultsError, ModevizError, PartError
from modeviz.files.broken_lines import without_broken_lines
from modeviz.files.draft import Draft
from modeviz.files.folder import VEHICLE_FILE, read_vehicle_text, vehicle_of
from modeviz.files.key_lines import key_lines, line_of
from modeviz.files.own_tables import BODIES, MOUNTS, names_in_body_table, names_in_mount_table
from modeviz.files.source import Source
from modeviz.files.toml_reader import tables_of
from modeviz.files.workload import check_workload
from modeviz.vehicle.bodies import Body
from modeviz.vehicle.vehicle import Vehicle

MOST_PROBLEMS = 200
"""Nobody mends more at once, and each takes another reading."""


@dataclass(frozen=True)
class Problem:
    """Something that has to be put right in a vehicle folder."""

    file: str
    """In the folder."""
    key: str
    """Its path in the file, "spring[3].stiffness"; empty for the whole."""
    words: str
    """What was found and what would be right."""
    line: int = 0
    """That of the key, from one; zero if it is none's."""
    left_out: str = ""
    """The key of what the rest was read without; empty if it could not be read at all."""

    def __str__(self) -> str:
        line = f"line {self.line}" if self.line else ""
        return f"{', '.join(filter(None, (self.file, line, self.key)))}: {self.words}"


@dataclass(frozen=True, eq=False)
class Survey:
    """What there is in a vehicle folder."""

    vehicle: Vehicle | None
    """Of all that is right; None if that is no body."""
    problems: tuple[Problem, ...]
    """Empty if `read_vehicle` reads the folder."""
    doubts: tuple[str, ...] = ()
    """What was taken otherwise than it stands, or is likely wrong."""

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The bodies that could be read."""
        return self.vehicle.bodies if self.vehicle else ()


def survey(folder: Path | str) -> Survey:
    """Return what can be read of a vehicle folder, with every problem that keeps the rest from it."""
    folder = Path(folder)
    try:
        text, broken = without_broken_lines(read_vehicle_text(folder), _error_of)
    except ModevizError as error:
        return Survey(None, (Problem(VEHICLE_FILE, "", _inside(folder, str(error))),))
    problems = [
        Problem(VEHICLE_FILE, "", b.words, b.number, f"line {b.number}" if text is not None else "")
        for b in broken
    ]
    if text is None:
        return Survey(None, tuple(problems))
    tables, source, lines = tables_of(text), Source(folder), list(key_lines(text))
    bodies, mounts = tables.get(BODIES), tables.get(MOUNTS)
    draft = Draft(tables, names_in_body_table(bodies, source), names_in_mount_table(mounts, source))
    problems += [
        Problem(VEHICLE_FILE, f.path, _inside(folder, f.words), line_of(f.path, lines), left_out)
        for f, left_out in islice(_mended(draft, source), MOST_PROBLEMS)
    ]
    if len(problems) >= MOST_PROBLEMS:
        problems.append(
            Problem(VEHICLE_FILE, "", "there may be more, which are looked for after these")
        )
    if draft.stand_ins:
        draft.drop_bodies()
        deque(_mended(draft, source), 0)  # what follows from a body that is lost is no problem more
    try:
        vehicle = vehicle_of(draft.tables, source.again())
    except ModevizError:
        return Survey(None, tuple(problems))
    return Survey(vehicle, (*problems, *_too_large(vehicle)), source.every_note)


def _error_of(text: str) -> str | None:
    """What keeps a text from being TOML."""
    try:
        tables_of(text)
    except ModevizError as error:
        return str(error)
    return None


def _mended(draft: Draft, source: Source) -> Iterator[tuple[Fault, str]]:
    """Take faults out of a draft until it can be read, or nothing more can be taken out.

    Yields each fault with the key of what was taken out for it.
    """
    while True:
        try:
            vehicle_of(draft.tables, source.again(draft.stand_ins))
        except ModevizError as error:
            taken = _taken_out(draft, error)
            yield from taken
            if any(not left_out for _, left_out in taken):
                return
        else:
            return


def _taken_out(draft: Draft, error: ModevizError) -> Sequence[tuple[Fault, str]]:
    """The faults that an error tells, each with the key of what is taken out of the draft for it.

    None where the error is about something that only missed what was taken out before.
    """
    if isinstance(error, FaultsError):
        return () if draft.drop_empty_groups() else draft.without(error.faults)
    if draft.drop_orphans():
        return ()
    if isinstance(error, PartError):
        return draft.without([Fault(draft.path_of(error.kind, error.name), str(error))])
    return [(Fault("", str(error)), "")]


def _too_large(vehicle: Vehicle) -> tuple[Problem, ...]:
    try:
        check_workload(vehicle)
    except ModevizError as error:
        return (Problem(VEHICLE_FILE, "", str(error)),)
    return ()


def _inside(folder: Path, words: str) -> str:
    """Words with the files of a folder by their names in it."""
    own = words.replace(f"{folder / VEHICLE_FILE}: ", "").removeprefix(f"{folder}: ")
    return own.replace(f"{folder}/", "")
