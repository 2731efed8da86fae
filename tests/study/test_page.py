"""The page of a study: in a notebook's cell without waiting, elsewhere until Ctrl+C."""

import gzip
import http.client
import os
import re
import signal
import sys
import threading
from base64 import b64decode
from html import unescape
from io import BytesIO
from types import SimpleNamespace
from urllib.parse import urlsplit

import pytest
from html_documents import Document
from PIL import Image
from studied_cabin import cabin_study
from visitors import wait_until

from modeviz.errors import ModevizError
from modeviz.study.page import Page
from modeviz.viewer.app import App
from modeviz.viewer.session.commands.decisions import TakeRates


@pytest.fixture
def notebook(monkeypatch):
    """As if this ran in a notebook's kernel."""
    shell = SimpleNamespace(kernel=None)
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))


def status(link: str) -> int | None:
    """What a link answers; None where nobody does."""
    url = urlsplit(link)
    connection = http.client.HTTPConnection(url.hostname or "", url.port, timeout=20)
    try:
        connection.request("GET", f"{url.path}?{url.query}")
    except ConnectionRefusedError:
        return None
    return connection.getresponse().status


def test_a_notebook_shows_the_page_in_its_cell_and_goes_on(notebook, capsys):
    study = cabin_study()
    study.rates["A.lateral"] = "200 N/mm"
    page = study.show(height=500)
    try:
        assert status(page.link) == 303
        assert status(page.link.partition("?")[0]) == 403
        shown = page._repr_mimebundle_()
        document = Document(f"<h1>cell</h1>{shown['text/html']}")
        assert document.addresses == [f"data:image/png;base64,{shown['image/png']}", page.link]
        assert '"height": 500' in shown["text/html"]
        assert page.link in capsys.readouterr().out
        assert page.rates == study.rates.by_group
    finally:
        page.close()
    assert status(page.link) is None


def test_a_page_in_a_cell_is_a_still_of_what_is_tuned_and_what_plays_without_a_server(notebook):
    study = cabin_study()
    page = study.show()
    try:
        before = page._repr_mimebundle_()
        study.rates["A.vertical"] = 1e5
        page.app.session.do(TakeRates(study.rates.by_group))
        after = page._repr_mimebundle_()
    finally:
        page.close()
    for bundle in (before, after):
        content = b64decode(bundle["image/png"])
        with Image.open(BytesIO(content)) as picture:
            assert picture.size == (960, 480)
            assert len(picture.convert("RGB").getcolors(picture.width * picture.height)) > 20
        assert len(content) < 150_000
        packed = re.search(r'"offline": "([^"]*)"', bundle["text/html"])
        assert b"<!doctype html>" in gzip.decompress(b64decode(packed[1])).lower()
    assert before["image/png"] != after["image/png"]
    small = study.show(offline=False)
    small.close()
    assert '"offline": ""' in small._repr_mimebundle_()["text/html"]


def test_a_closed_page_still_shows_what_it_was(notebook):
    page = cabin_study().show()
    before = page._repr_mimebundle_()
    page.close()
    assert page._repr_mimebundle_()["image/png"] == before["image/png"]


def test_a_cell_that_is_run_again_closes_what_it_showed_though_its_study_is_new(notebook, monkeypatch):
    told = {"metadata": {"cellId": "first"}}
    monkeypatch.setattr(sys.modules["IPython"].get_ipython(), "get_parent", lambda: told, raising=False)
    first, second = cabin_study().show(), cabin_study().show()
    told["metadata"] = {"cellId": "second"}
    third = cabin_study().show()
    try:
        assert [status(page.link) for page in (first, second, third)] == [None, 303, 303]
    finally:
        second.close()
        third.close()


def test_marimo_is_a_notebook_which_runs_the_cells_script_in_a_frame(monkeypatch):
    marimo = SimpleNamespace(running_in_notebook=lambda: True)
    monkeypatch.setitem(sys.modules, "marimo", marimo)
    page = cabin_study().show(height=400)
    try:
        kind, html = page._mime_()
    finally:
        page.close()
    assert kind == "text/html"
    inner = re.fullmatch(r'<iframe .* srcdoc="([^"]*)".*></iframe>', html, re.DOTALL)
    assert page.link in unescape(inner[1]).replace("&amp;", "&")
    assert "<script>" in unescape(inner[1])


def test_rates_that_were_tuned_on_the_page_are_used(notebook):
    study = cabin_study()
    page = study.show()
    try:
        softer = {**page.rates, "B": study.vehicle.rate_sets["soft"]["A"]}
        page.app.session.do(TakeRates(softer))
        study.rates.use(page.rates)
    finally:
        page.close()
    assert study.rates["B.vertical"] == 2e5


def test_a_page_that_is_shown_again_is_closed_first(notebook):
    study = cabin_study()
    first = study.show()
    second = study.show()
    try:
        assert status(first.link) is None
        assert status(second.link) == 303
    finally:
        second.close()


def test_a_page_may_be_closed_twice(notebook):
    study = cabin_study()
    first = study.show()
    first.close()
    first.close()
    second = study.show()
    second.close()
    assert status(second.link) is None


def test_outside_of_notebooks_the_page_is_shown_until_ctrl_c(capsys):
    has_ended = threading.Event()

    def interrupt() -> None:
        while not has_ended.wait(0.05):
            if waits_in(Page.wait):
                os.kill(os.getpid(), signal.SIGINT)  # to the main thread
                has_ended.wait(5)  # a wait misses one that comes as it begins

    interrupting = threading.Thread(target=interrupt, daemon=True)
    interrupting.start()
    page = cabin_study().show()
    has_ended.set()
    interrupting.join()
    assert page.link in capsys.readouterr().out
    assert status(page.link) is None


def waits_in(function) -> bool:
    """Whether the main thread waits for an event in a function: its wait, that of a condition."""
    frames = [sys._current_frames()[threading.main_thread().ident or 0]]
    while frames[-1].f_back and len(frames) < 3:
        frames.append(frames[-1].f_back)
    return frames[-1].f_code is function.__code__


def test_a_vehicle_without_a_road_is_shown_too(notebook):
    page = cabin_study(roads=(), problems=()).show()
    try:
        assert status(page.link) == 303
    finally:
        page.close()


def test_a_page_that_cannot_begin_leaves_no_thread(notebook, monkeypatch):
    def broken(*_):
        raise ModevizError("no answer")

    before = set(threading.enumerate())
    monkeypatch.setattr(App, "start", broken)
    with pytest.raises(ModevizError, match="no answer"):
        cabin_study().show()
    wait_until(lambda: set(threading.enumerate()) <= before)
