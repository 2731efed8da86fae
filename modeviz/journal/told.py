"""The history of a study as it is read on a terminal, and as plain values for JSON."""

import time
from collections.abc import Iterable
from dataclasses import asdict

from modeviz.errors import cut
from modeviz.journal.differences import told
from modeviz.journal.history import Entry
from modeviz.journal.records import Study
from modeviz.journal.sessions import ReviewLine, SessionLine
from modeviz.report.records import Record

MOST_DIFFERENCES = 6
"""Of a change in a line; the others are counted."""

CHANGES = ("step", "undo", "redo")
"""Kinds of entries whose titles say what was done."""

LONGEST_TITLE = 200
"""Letters of what is told in a line."""


def log_text(name: str, study: Study, sessions: Iterable[SessionLine], entries: Iterable[Entry]) -> str:
    """Return the history, a line an entry: when, in which session, by whom, and what.

    Args:
        name: of the file.
        study: of what it is.
        sessions: which are there.
        entries: in their order, which is not that of their times where a clock was set back.
    """
    heads = [
        f"session {s.number}{f' {s.title!r}' if s.title else ''}, begun {moment(s.begun)}"
        f"{f' by {s.author}' if s.author else ''}, used {moment(s.used)}"
        for s in sessions
    ]
    heads += [_review_text(s.number, review) for s in sessions for review in s.reviews]
    lines = [entry_text(entry) for entry in entries]
    head = f"{name}: study of {study.vehicle_name}, begun {moment(study.begun)}"
    return "\n".join([head, *heads, "", *(lines or ["nothing happened yet"])])


def entry_text(entry: Entry) -> str:
    """Return an entry in a line."""
    session = "all" if entry.session is None else f"{entry.session:>3}"
    kind = "" if entry.kind in CHANGES else f"{entry.kind}: "
    title = cut(" ".join(entry.title.split()), LONGEST_TITLE)
    differences = [] if entry.kind in ("undo", "redo") else [told(d) for d in entry.differences]
    n_more = len(differences) - MOST_DIFFERENCES
    said = [*differences[:MOST_DIFFERENCES], *([f"{n_more} more"] if n_more > 0 else [])]
    words = f"{kind}{title}{': ' if said else ''}{'; '.join(said)}"
    undone = " (undone)" if entry.is_undone else ""
    return f"{entry.number:>5}  {moment(entry.time)}  {session}  {entry.author or '-'}  {words}{undone}"


def _review_text(session: int, review: ReviewLine) -> str:
    until = f"ended {moment(review.ended)}" if review.ended else "goes on"
    by = f" by {review.author}" if review.author else ""
    return f"review of session {session}, shared {moment(review.begun)}{by}, {until}"


def log_record(study: Study, sessions: Iterable[SessionLine], entries: Iterable[Entry]) -> Record:
    """Return the history as plain values.

    `{"vehicle", "begun", "sessions": [{"number", "title", "author", "begun", "used", "n_changes",
    "variants": [name], "reviews": [{"author", "begun", "ended": time or null}]}], "entries":
    [{"number", "session": number or null, "time", "author", "kind", "title", "differences": [{"what",
    "before", "after"}], "is_undone"}]}`; times are UTC, ISO 8601.
    """
    return {
        "vehicle": study.vehicle_name,
        "begun": utc(study.begun),
        "sessions": [session_record(session) for session in sessions],
        "entries": [entry_record(entry) for entry in entries],
    }


def session_record(session: SessionLine) -> Record:
    """Return a session of a list; without its digest, for that is nobody's business."""
    return {
        "number": session.number,
        "title": session.title,
        "author": session.author,
        "begun": utc(session.begun),
        "used": utc(session.used),
        "n_changes": session.n_changes,
        "variants": list(session.variants),
        "reviews": [
            {
                "author": review.author,
                "begun": utc(review.begun),
                "ended": None if review.ended is None else utc(review.ended),
            }
            for review in session.reviews
        ],
    }


def entry_record(entry: Entry) -> Record:
    """Return an entry of `log_record`."""
    return {**asdict(entry), "time": utc(entry.time)}


def moment(seconds: float) -> str:
    """Return a time as somebody there reads it: "2026-11-29 13:02:11"."""
    return time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(seconds))


def utc(seconds: float) -> str:
    """Return a time as a program reads it: "2026-11-29T13:02:11Z"."""
    return time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(seconds))
