"""The files that a study draws."""

import base64
import io
from dataclasses import replace

import av
import numpy as np
import pytest
from html_documents import Document
from mounted_cabin import mounted_cabin
from PIL import Image
from studied_cabin import cabin_study

from modeviz.errors import ModevizError
from modeviz.study.study import Study
from modeviz.vehicle.bodies import Material, MeshPart


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


def panelled_bodies():
    """Those of the cabin, which has a side that can be seen."""
    cab, *others = mounted_cabin().bodies
    corners = np.array([[0.4, -0.6, 0.7], [2.0, -0.6, 0.7], [2.0, -0.6, 1.6], [0.4, -0.6, 1.6]])
    faces = np.array([[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]])
    side = MeshPart("side", corners, faces, Material((202, 134, 98)))
    return replace(cab, mesh=(side,)), *others


@pytest.mark.browser
def test_pictures_and_a_report_are_drawn_as_asked_for_and_shown_in_a_notebook(tmp_path):
    study = cabin_study(bodies=panelled_bodies())
    study.rates["A.lateral"] = "150 N/mm"
    size = {"width": 320, "height": 180}
    files = [
        study.render(tmp_path / f"yaw.{kind}", "cab yaw", frames=4, **size)
        for kind in ("png", "gif", "mp4")
    ]
    still, loop = (Image.open(file) for file in files[:2])
    assert still.size == loop.size == (320, 180)
    assert loop.n_frames == 4
    with av.open(str(files[2].path)) as film:
        (frame, *_) = film.decode(video=0)
    assert (frame.width, frame.height) == (320, 180)
    assert all(len(picture.convert("RGB").getcolors(320 * 180)) > 50 for picture in (still, loop))
    written = study.report(tmp_path / "report.html")
    page = Document(written.path.read_text())
    drawn = [address for address in page.addresses if address.startswith("data:image/png")]
    pictures = [Image.open(io.BytesIO(base64.b64decode(d.partition(",")[2]))) for d in drawn]
    assert [picture.size for picture in pictures] == [(1280, 800)] * 2
    for file in (*files, written):
        assert len(Document(f"<h1>cell</h1>{file._repr_html_()}").addresses) == 1
