"""Notes of a study appear in the report, by what they are pinned to."""

import pytest
from html_documents import Document
from journal_studies import KEY, opened

from modeviz.cli import main
from modeviz.report.html.notes import study_notes
from modeviz.report.notes import Note

NOTES = (
    Note("too soft <in> roll\nask Bob", "mount", "C2 & left", "Ada", 1e9),
    Note("for Monday"),
    Note("too low", "mode", "cab yaw", "Bob"),
)


def test_notes_are_told_by_what_they_are_pinned_to():
    document = Document(study_notes(NOTES))
    rows = document.tables["Notes"][1:]
    assert [row[0] for row in rows] == [
        "On the study",
        "Study",
        "On modes",
        "cab yaw",
        "On mounts",
        "C2 & left",
    ]
    assert rows[-1][1:] == ["too soft <in> rollask Bob", "Ada", "2001-09-09"]


def test_without_notes_there_is_no_section():
    assert study_notes(()) == ""


@pytest.mark.parametrize(("session", "expected"), [([], 3), (["--session", "1"], 2)])
def test_a_report_has_the_notes_of_a_study(folder, tmp_path, session, expected):
    study = opened(tmp_path / "truck.modeviz")
    other = study.session_id("another-key")
    for key, note in zip((KEY, None, other), NOTES, strict=True):
        study.begin(key or KEY)
        study.put_note(key, note)
    study.close()
    output = tmp_path / "report.html"
    words = ["--no-pictures", "--notes", str(study.path), *session, "--output", str(output)]
    assert main(["report", folder, *words]) == 0
    rows = Document(output.read_text("utf-8")).tables["Notes"][1:]
    assert sum(len(row) > 1 for row in rows) == expected


def test_a_study_that_is_not_there_is_said_before_anything_is_solved(folder, tmp_path, capsys):
    words = ["--no-pictures", "--output", str(tmp_path / "report.html")]
    assert main(["report", folder, *words, "--notes", str(tmp_path / "none")]) == 2
    assert "there is no such folder" in capsys.readouterr().err
    assert main(["report", folder, *words, "--session", "1"]) == 2
    assert "--notes names" in capsys.readouterr().err
