"""All of a study for other programs: as JSON, and its variants as a table."""

import csv
import json
from base64 import b64encode
from collections.abc import Iterator
from dataclasses import asdict
from io import StringIO
from typing import Any

from modeviz.journal.pictures import PictureLine
from modeviz.journal.records import Records
from modeviz.journal.runs import Run
from modeviz.journal.sessions import SessionLine, StoredSession
from modeviz.journal.told import entry_record, session_record, utc
from modeviz.journal.tuning import Pinned
from modeviz.report.notes import Note
from modeviz.report.places import placements_record
from modeviz.report.records import Record
from modeviz.vehicle.mount_rates import RATE_FIELDS, MountRates, spoken_unit, spoken_value

FORM = 1
"""Of the record; a later one that is read otherwise has a higher number."""

UNTOLD = {"token", "is_for_all"}


def study_record(records: Records) -> Record:
    """Return all of a study but the keys of its sessions, which it does not have.

    `{"form", "vehicle", "begun", "units": {field: unit}, "sessions": [{the fields of
    `told.session_record`, "vehicle_parts": {part: digest}, "rates", "placements", "pinned": {name:
    {"rates", "placements"}}, "states", "state", "undo": [{"before", "after"}], "redo", "notes", "runs",
    "pictures": [{"caption", "author", "time", "png_base64"}]}], "notes": those for all, "history": the
    entries of `told.log_record`}`; `rates` are `{group: {field: value}}`, states and records of runs as
    the session wrote them; "state", "before" and "after" are places in the list "states".
    """
    study = records.study()
    return {
        "form": FORM,
        "vehicle": study.vehicle_name,
        "begun": utc(study.begun),
        "units": {field: spoken_unit(field) for field in RATE_FIELDS},
        "sessions": [_session(records, line) for line in records.sessions()],
        "notes": [_told(note) for note in records.notes() if note.is_for_all],
        "history": [entry_record(entry) for entry in records.history()],
    }


def variants_table(records: Records) -> str:
    """Return the variants of a study as CSV: a row for each group of each, rates with their units."""
    columns = [f"{field} ({spoken_unit(field)})" for field in RATE_FIELDS]
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["session", "variant", "group", *columns, "loss_factor"])
    writer.writerows(_rows(records))
    return text.getvalue()


def pinned_record(pinned: Pinned) -> Record:
    """Return rates, in the units of `mount_rates.spoken_unit`, and places of a variant."""
    return {
        "rates": {group: _rates(rates) for group, rates in pinned.rates.items()},
        "placements": placements_record(pinned.placements),
    }


def _rates(rates: MountRates) -> Record:
    fields = {field: spoken_value(rates, field) for field in RATE_FIELDS}
    return {**fields, "loss_factor": rates.loss_factor}


def _rows(records: Records) -> Iterator[list[Any]]:
    for line in records.sessions():
        session = records.restore(line.id)
        assert session is not None
        for name, pinned in session.tuning.variants.items():
            for group, rates in pinned.rates.items():
                yield [line.number, name, group, *_rates(rates).values()]


def _session(records: Records, line: SessionLine) -> Record:
    session = records.restore(line.id)
    assert session is not None
    return {
        **session_record(line),
        "vehicle_parts": dict(session.vehicle.parts),
        **pinned_record(session.tuning.present),
        "pinned": {name: pinned_record(p) for name, p in session.tuning.variants.items()},
        **_states(session),
        "notes": [_told(note) for note in records.notes(line.id) if not note.is_for_all],
        "runs": [{**_told(run), "record": _plain(run.record)} for run in records.runs(line.id)],
        "pictures": [
            {**_told(p), "png_base64": b64encode(records.picture(line.id, p.token) or b"").decode()}
            for p in records.pictures(line.id)
        ],
    }


def _states(session: StoredSession) -> Record:
    """Each state once, and by their places which is the present one and what leads where."""
    steps = (*session.past, *session.future)
    now = () if session.state is None else (session.state,)
    texts = tuple(
        dict.fromkeys((*now, *(text for step in steps for text in (step.before, step.after))))
    )
    place = {text: i for i, text in enumerate(texts)}
    undo, redo = (
        [{"before": place[step.before], "after": place[step.after]} for step in its]
        for its in (session.past, session.future)
    )
    state = 0 if now else None
    return {"states": [_plain(text) for text in texts], "state": state, "undo": undo, "redo": redo}


def _told(thing: Note | Run | PictureLine) -> Record:
    """The fields of something, without those by which it is found."""
    fields = {name: value for name, value in asdict(thing).items() if name not in UNTOLD}
    return {**fields, "time": utc(thing.time)}


def _plain(text: str) -> Any:
    """What a JSON text says; a text that is none as it stands."""
    try:
        return json.loads(text)
    except ValueError:
        return text
