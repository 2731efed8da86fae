"""Whether the tables of a file hold what those of a study do: it may be damaged, or a stranger's."""

import sqlite3
from functools import cache
from sqlite3 import Connection

from modeviz.journal.schema import STEPS, version_of

FARTHEST = 1e11
"""s from 1970, in the year 5138: no time is later."""


def wrong_table(connection: Connection) -> str | None:
    """Return a table that is missing, or has other columns or values than a study's; else None."""
    for table, columns in _expected(version_of(connection)).items():
        if _columns(connection, table) != columns:
            return table
        wrong = " OR ".join(f"NOT ({_is_right(*column)})" for column in columns)
        if connection.execute(f"SELECT 1 FROM {table} WHERE {wrong} LIMIT 1").fetchone():
            return table
    dangling = connection.execute("PRAGMA foreign_key_check").fetchone()
    return dangling and dangling[0]


Column = tuple[str, str, bool]
"""Name, type, and whether there is always a value."""


@cache
def _expected(version: int) -> dict[str, list[Column]]:
    model = sqlite3.connect(":memory:")
    try:
        model.executescript("".join(STEPS[:version]))
        query = "SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite%'"
        return {table: _columns(model, table) for (table,) in model.execute(query).fetchall()}
    finally:
        model.close()


def _columns(connection: Connection, table: str) -> list[Column]:
    rows = connection.execute(f"PRAGMA table_info({table})")
    return [(name, kind, bool(is_needed or key)) for _, name, kind, is_needed, _, key in rows]


def _is_right(name: str, kind: str, is_needed: bool) -> str:
    """A condition on a column's value."""
    right = f"typeof({name}) = '{kind.lower()}'"
    if kind == "REAL":
        right += f" AND abs({name}) < {FARTHEST}"
    return right if is_needed else f"({name} IS NULL OR {right})"
