"""The files that a study draws: here those that need no browser."""

import pytest
from html_documents import Document
from studied_cabin import cabin_study

from modeviz.errors import ModevizError
from modeviz.study.study import Study


def test_a_page_that_still_moves_is_written_and_shown_in_a_notebook(tmp_path):
    told: list[str] = []
    study = Study(cabin_study().vehicle, progress=lambda what, done: told.append(what))
    written = study.render(tmp_path / "yaw.html", mode="cab yaw")
    assert "<title>cabin: Cab yaw" in written.path.read_text()
    shown = Document(f"<h1>cell</h1>{written._repr_html_()}")
    assert [address[:21] for address in shown.addresses] == ["data:text/html;base64"]
    assert "preparing" in told


def test_a_mode_that_is_not_there_is_said_and_nothing_is_written(tmp_path):
    with pytest.raises(ModevizError, match=r"unknown mode 'cab jaw': there are "):
        cabin_study().render(tmp_path / "jaw.html", mode="cab jaw")
    assert list(tmp_path.iterdir()) == []
