"""Texts and pictures by their digest: what is there twice is stored once."""

import hashlib
import zlib
from sqlite3 import Connection

from modeviz.errors import ModevizError
from modeviz.journal.schema import HOLDERS

FAST = 3
"""zlib's level: states of some kilobytes shrink to a fifth in 0.1 ms."""


LARGEST = 100_000_000
"""Bytes of a content that are read: a state has some kilobytes, a picture some megabytes."""


def put_text(connection: Connection, text: str) -> int:
    """Stores a text, as `put_content`."""
    return put_content(connection, text.encode())


def text(connection: Connection, number: int) -> str:
    """Return a stored text; raises as `content`."""
    return content(connection, number).decode()


def put_content(connection: Connection, content: bytes) -> int:
    """Stores a content, unless it is there, and returns its number."""
    digest = hashlib.sha256(content).digest()
    found = connection.execute("SELECT id FROM content WHERE sha256 = ?", (digest,)).fetchone()
    if found:
        return found[0]
    packed = zlib.compress(content, FAST)
    insert = "INSERT INTO content (sha256, packed) VALUES (?, ?)"
    return connection.execute(insert, (digest, packed)).lastrowid or 0


def content(connection: Connection, number: int) -> bytes:
    """Return a stored content.

    Raises:
        ModevizError: it is not as it was written.
    """
    row = connection.execute("SELECT sha256, packed FROM content WHERE id = ?", (number,)).fetchone()
    if row is None:
        raise ModevizError(f"content {number} of the study is missing: the file is damaged")
    try:
        unpacked = zlib.decompressobj().decompress(row[1], LARGEST)
    except zlib.error:
        unpacked = b""
    if hashlib.sha256(unpacked).digest() != row[0]:
        raise ModevizError(
            f"content {number} of the study is not as it was written: the file is damaged"
        )
    return unpacked


def drop_unheld(connection: Connection, *numbers: int | None) -> None:
    """Forgets those of some contents that nothing refers to any more."""
    unheld = " AND ".join(f"NOT EXISTS (SELECT 1 FROM {t} WHERE {c} = :id)" for t, c in HOLDERS)
    for number in {*numbers} - {None}:
        connection.execute(f"DELETE FROM content WHERE id = :id AND {unheld}", {"id": number})
