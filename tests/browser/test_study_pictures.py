"""The files that a study draws."""

from io import BytesIO

from PIL import Image
from studied_cabin import cabin_study


def test_a_study_writes_a_picture_that_a_notebook_shows(tmp_path):
    study = cabin_study()
    written = study.render(tmp_path / "yaw.png", mode="cab yaw", width=96, height=64)
    assert Image.open(BytesIO(written.path.read_bytes())).size == (96, 64)
    assert 'src="data:image/png;base64,' in written._repr_html_()
