"""The page of a study: in a notebook's cell without waiting, elsewhere until Ctrl+C."""

import http.client
import os
import signal
import sys
import threading
from types import SimpleNamespace
from urllib.parse import urlsplit

import pytest
from html_documents import Document
from studied_cabin import cabin_study

from modeviz.study.page import Page
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
        document = Document(f"<h1>cell</h1>{page._repr_html_()}")
        assert document.addresses == [page.link, page.link]
        assert 'height="500"' in page._repr_html_()
        assert page.link in capsys.readouterr().out
        assert page.rates == study.rates.by_group
    finally:
        page.close()
    assert status(page.link) is None


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
