"""The changes of a session: written as they are accepted, and what can be undone read back."""

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field, replace
from sqlite3 import Connection
from typing import Literal

from modeviz.journal.contents import drop_unheld, put_text, text
from modeviz.journal.schema import next_id
from modeviz.journal.tuning import Tuning

LONGEST = 500
"""So many changes of a session can be undone, before a restart and after it."""

Kind = Literal["step", "longer", "back", "undo", "redo"]
"""A "step" can be undone; a "longer" one is the last step that goes on, as while dragging; one that
leads "back" to where the last step began leaves no step. The others undo the last step, or redo the
last that was undone."""


@dataclass(frozen=True)
class Difference:
    """One thing that a change changed, in engineers' words and units."""

    what: str
    """Such as "C2.lateral"."""
    before: str
    """Such as "131 N/mm"; empty for what was not there."""
    after: str


@dataclass(frozen=True)
class Change:
    """Something that a session accepted."""

    kind: Kind
    title: str
    """What was done, such as "Set C2.lateral"."""
    before: str
    """The state before the step that it is or belongs to, as text."""
    after: str
    """The state after that step; for undoing too, so that redoing leads there."""
    author: str = ""
    """The name of who did it."""
    differences: tuple[Difference, ...] = ()
    """Between before and after."""
    tuning: Tuning = field(default_factory=Tuning)
    """As it is now."""
    maker: str = ""
    """The digest of the key of a visitor who did it, whatever the name is; empty: the owner did."""

    @property
    def state(self) -> str:
        """The session's state now."""
        return self.before if self.kind in ("undo", "back") else self.after


@dataclass(frozen=True)
class Step:
    """A change that can be undone or redone: the states around it."""

    before: str
    after: str
    author: str = field(default="", compare=False)
    maker: str = ""
    """Whose step it is, see `Change.maker`."""


def write_change(connection: Connection, session: int, change: Change, now: float) -> None:
    """Writes a change, and what it makes of the steps that can be undone."""
    match change.kind:
        case "step":
            _drop_undone(connection, session)
            _insert(connection, session, change, "done", now)
        case "longer":
            _lengthen(connection, session, _last(connection, session, "done"), change, now)
        case "back":
            _remove(connection, _last(connection, session, "done"))
        case "undo":
            _move(connection, session, change, "done", "undone", now)
        case "redo":
            _move(connection, session, change, "undone", "done", now)


def steps(connection: Connection, session: int, place: Literal["done", "undone"]) -> tuple[Step, ...]:
    """Return the steps that can be undone, or redone, the next one last; not more than `LONGEST`."""
    order = "DESC" if place == "done" else "ASC"
    rows = connection.execute(
        "SELECT before, after, author, maker FROM change WHERE session = ? AND place = ?"
        f" ORDER BY id {order} LIMIT ?",
        (session, place, LONGEST),
    ).fetchall()
    states = {number: text(connection, number) for row in rows for number in row[:2]}
    return tuple(Step(states[before], states[after], *who) for before, after, *who in reversed(rows))


def differences_text(differences: Iterable[Difference]) -> str:
    """Return differences as JSON."""
    return json.dumps([asdict(each) for each in differences], ensure_ascii=False)


def differences_of(text: str) -> tuple[Difference, ...]:
    """Return the differences that a JSON text is."""
    return tuple(Difference(**each) for each in json.loads(text))


def _put(connection: Connection, change: Change) -> tuple[int, int, int]:
    """Stores the states before and after a change, and the differences."""
    contents = (change.before, change.after, differences_text(change.differences))
    before, after, differences = (put_text(connection, each) for each in contents)
    return before, after, differences


def _insert(connection: Connection, session: int, change: Change, place: str, now: float) -> int:
    """Writes a change as a line of its own; returns its id."""
    before, after, differences = _put(connection, change)
    number = next_id(connection)
    connection.execute(
        "INSERT INTO change (id, session, time, author, maker, kind, title, differences, place,"
        " before, after) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        (
            number,
            session,
            now,
            change.author,
            change.maker,
            change.kind,
            change.title,
            differences,
            place,
            before if place else None,
            after if place else None,
        ),
    )
    return number


def _last(connection: Connection, session: int, place: str) -> int | None:
    """The step that is undone, or redone, next."""
    order = "max" if place == "done" else "min"
    query = f"SELECT {order}(id) FROM change WHERE session = ? AND place = ?"
    return connection.execute(query, (session, place)).fetchone()[0]


def _lengthen(
    connection: Connection, session: int, step: int | None, change: Change, now: float
) -> None:
    """Gives a step other states, and differences between them."""
    if step is None:
        _insert(connection, session, change, "done", now)
        return
    held = _contents(connection, step)
    before, after, differences = _put(connection, change)
    connection.execute(
        "UPDATE change SET before = ?, after = ?, time = ?, author = ?, maker = ?, title = ?,"
        " differences = ? WHERE id = ?",
        (
            before,
            after,
            now,
            change.author,
            change.maker,
            change.title,
            differences,
            step,
        ),
    )
    drop_unheld(connection, *held)


def _move(
    connection: Connection, session: int, change: Change, place: str, new: str, now: float
) -> None:
    """Undoes or redoes a step, whose states are those of looks then and now."""
    step = _last(connection, session, place)
    if step is None:
        step = _put_missing(connection, session, change, now)
    held = _contents(connection, step)
    before, after, _ = _put(connection, change)
    connection.execute(
        "UPDATE change SET before = ?, after = ?, place = ? WHERE id = ?", (before, after, new, step)
    )
    _insert(connection, session, change, "", now)
    drop_unheld(connection, *held)


def _put_missing(connection: Connection, session: int, change: Change, now: float) -> int:
    """Writes the step that a change undoes or redoes, which is not there; returns its id.

    What was undone already gets greater ids: it is redone after that step.
    """
    step = _insert(connection, session, replace(change, kind="step"), "done", now)
    query = "SELECT id FROM change WHERE session = ? AND place = 'undone' ORDER BY id"
    for (undone,) in connection.execute(query, (session,)).fetchall():
        new = next_id(connection)
        connection.execute("UPDATE change SET id = ? WHERE id = ?", (new, undone))
    return step


def _remove(connection: Connection, step: int | None) -> None:
    held = _contents(connection, step)
    connection.execute("DELETE FROM change WHERE id = ?", (step,))
    drop_unheld(connection, *held)


def _drop_undone(connection: Connection, session: int) -> None:
    """Keeps what was undone for the history alone."""
    connection.execute(
        "UPDATE change SET place = 'gone' WHERE session = ? AND place = 'undone'", (session,)
    )


def _contents(connection: Connection, step: int | None) -> tuple[int | None, ...]:
    query = "SELECT before, after, differences FROM change WHERE id = ?"
    return connection.execute(query, (step,)).fetchone() or ()
