"""What two studies differ in: vehicles, sessions' rates and variants, notes and runs."""

from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field

from modeviz.errors import ModevizError
from modeviz.journal.changes import Difference
from modeviz.journal.differences import pinned_differences, told
from modeviz.journal.records import Records
from modeviz.journal.sessions import SessionLine, StoredSession
from modeviz.journal.tuning import Pinned
from modeviz.report.records import Record


@dataclass(frozen=True)
class SetDifference:
    """In what a set of rates that both have differs."""

    name: str
    """Of a variant; empty: the present rates."""
    differences: tuple[Difference, ...]


@dataclass(frozen=True)
class SessionDifference:
    """In what two sessions differ."""

    first: int
    """Its number in the first study."""
    second: int
    vehicle: tuple[str, ...]
    """Parts of the vehicle that are other in the second."""
    sets: tuple[SetDifference, ...]
    only_first: tuple[str, ...]
    """What the first has alone, in words: "variant v1", "note on mode cab yaw: too low"."""
    only_second: tuple[str, ...]

    @property
    def is_empty(self) -> bool:
        """Whether there is none."""
        return not (self.vehicle or self.sets or self.only_first or self.only_second)


@dataclass(frozen=True)
class StudyDifference:
    """In what two studies differ."""

    names: tuple[str, str]
    """Of their files."""
    vehicles: tuple[str, str]
    sessions: tuple[SessionDifference, ...]
    """Of the sessions that both have, or if there is none of those last used; equal ones too."""
    only_first: tuple[int, ...] = field(default=())
    """The numbers of sessions that the first has alone."""
    only_second: tuple[int, ...] = field(default=())


def compare_studies(first: Records, second: Records) -> StudyDifference:
    """Return in what two studies differ.

    Sessions are the same if they have the same key, as in a copy of a study. Studies that share none
    are compared by the sessions that were used last.

    Raises:
        ModevizError: one cannot be read, or has no session.
    """
    lines = [records.sessions() for records in (first, second)]
    for records, its in zip((first, second), lines, strict=True):
        if not its:
            raise ModevizError(f"{records.path}: has no session yet, so there is nothing to compare")
    pairs = list(_pairs(*lines))
    return StudyDifference(
        (first.path.name, second.path.name),
        (first.study().vehicle_name, second.study().vehicle_name),
        tuple(_compare(first, one, second, other) for one, other in pairs),
        tuple(line.number for line in lines[0] if line not in [one for one, _ in pairs]),
        tuple(line.number for line in lines[1] if line not in [other for _, other in pairs]),
    )


def difference_text(difference: StudyDifference) -> str:
    """Return it as lines; "-" is before what the first has alone, "+" what the second has."""
    first, second = difference.names
    lines = [f"- {first}", f"+ {second}"]
    if difference.vehicles[0] != difference.vehicles[1]:
        lines.append("vehicle {} → {}".format(*difference.vehicles))
    lines += [f"- session {number}" for number in difference.only_first]
    lines += [f"+ session {number}" for number in difference.only_second]
    for session in difference.sessions:
        lines += [f"session {session.first} and session {session.second}:"]
        lines += [f"  {line}" for line in _session_lines(session)]
    return "\n".join(lines)


def difference_record(difference: StudyDifference) -> Record:
    """Return it as plain values: the fields of `StudyDifference`."""
    return asdict(difference)


def _session_lines(session: SessionDifference) -> Iterator[str]:
    if session.is_empty:
        yield "no difference"
    yield from (f"vehicle: {part}" for part in session.vehicle)
    for each in session.sets:
        prefix = f"variant {each.name}: " if each.name else ""
        yield from (f"{prefix}{told(one)}" for one in each.differences)
    yield from (f"- {words}" for words in session.only_first)
    yield from (f"+ {words}" for words in session.only_second)


def _pairs(
    first: Iterable[SessionLine], second: Iterable[SessionLine]
) -> Iterator[tuple[SessionLine, SessionLine]]:
    by_id = {line.id: line for line in second}
    shared = [(line, by_id[line.id]) for line in first if line.id in by_id]
    yield from shared or [(_last_used(first), _last_used(second))]


def _last_used(lines: Iterable[SessionLine]) -> SessionLine:
    return max(lines, key=lambda line: (line.used, line.number))


def _compare(
    first: Records, one: SessionLine, second: Records, other: SessionLine
) -> SessionDifference:
    before, after = _stored(first, one), _stored(second, other)
    old, new = before.tuning.variants, after.tuning.variants
    sets = [("", before.tuning.present, after.tuning.present)]
    sets += [(name, old[name], new[name]) for name in old if name in new]
    words = [set(_words(first, one)), set(_words(second, other))]
    return SessionDifference(
        one.number,
        other.number,
        after.vehicle.changed_since(before.vehicle),
        tuple(_set_differences(sets)),
        tuple(word for word in _words(first, one) if word not in words[1]),
        tuple(word for word in _words(second, other) if word not in words[0]),
    )


def _set_differences(sets: Iterable[tuple[str, Pinned, Pinned]]) -> Iterator[SetDifference]:
    for name, old, new in sets:
        differences = pinned_differences(old, new)
        if differences:
            yield SetDifference(name, differences)


def _words(records: Records, line: SessionLine) -> Iterator[str]:
    """What a session has beside rates, in words."""
    yield from (f"variant {name}" for name in line.variants)
    for note in records.notes(line.id):
        yield f"note on {note.about}: {' '.join(note.text.split())}"
    yield from (f"{run.kind}: {run.title}" for run in records.runs(line.id))
    yield from (f"picture: {picture.caption}" for picture in records.pictures(line.id))


def _stored(records: Records, line: SessionLine) -> StoredSession:
    session = records.restore(line.id)
    assert session is not None
    return session
