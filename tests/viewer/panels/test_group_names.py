"""What the page and a report call a mount group."""

import re
from contextlib import closing
from dataclasses import replace
from datetime import date

import pytest
import viser
from mounted_cabin import mounted_cabin
from session_commands import Listener

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html import report
from modeviz.viewer.page.widgets.handles import name_of
from modeviz.viewer.page.widgets.html import HiddenButtons
from modeviz.viewer.panels.energy import EnergyPanel
from modeviz.viewer.panels.forces import ForcesPanel
from modeviz.viewer.panels.mounts.folder import GroupFolder
from modeviz.viewer.panels.paths import PathsPanel
from modeviz.viewer.panels.statics import StaticPanel
from modeviz.viewer.session.commands.looks import ChangeCharts
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import first_state


@pytest.fixture(scope="module")
def vehicle():
    """A cabin whose front mounts have no label but their name."""
    cabin = mounted_cabin()
    front, rear = cabin.mount_groups
    return replace(cabin, mount_groups=(replace(front, name="FM", label="FM"), rear), rate_sets={})


def test_the_page_names_a_group_once_whose_label_is_its_name(vehicle):
    session = Session(vehicle, first_state(vehicle, vehicle.rates, Conditions("flat", 20.0)), print)
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    contents = []
    add, server.gui.add_html = (
        server.gui.add_html,
        lambda text: contents.append(add(text)) or contents[-1],
    )
    try:
        session.start()
        solved = session.wait_for_answer(20)
        EnergyPanel(server.gui, session).show(solved)
        energies = "".join(content.content for content in contents)
        buttons = HiddenButtons(server.gui, 9, print)
        folders = [GroupFolder(server.gui, session, g, buttons)._folder for g in vehicle.mount_groups]
        assert [folder.label for folder in folders] == ["FM", "B  rear"]
    finally:
        session.close()
        server.stop()
    assert 'title="FM"' in energies
    assert 'title="B rear"' in energies


def test_a_report_names_it_once_too(vehicle):
    sets = RateSet("original", {}), RateSet("now", {})
    html = report(compare(prepare(vehicle), *sets, None), date(2026, 11, 29))
    assert "FM <small>" not in html
    assert "B <small>rear</small>" in html


@pytest.mark.parametrize("panel", [EnergyPanel, ForcesPanel, StaticPanel])
def test_a_click_selects_the_group_that_was_clicked_though_another_list_came_meanwhile(panel):
    """As where an absorber before it was taken away: its place in the list is another's then."""
    cabin = mounted_cabin()
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    shown, told = None, []
    try:
        for vehicle in (cabin, replace(cabin, mount_groups=cabin.mount_groups[::-1])):
            state = first_state(vehicle, vehicle.rates, Conditions("flat", 20.0))
            with closing(Session(vehicle, state, Listener())) as session:
                shown = shown or panel(server.gui, session)
                session.start()
                shown.show(session.wait_for_answer(20))
            told.append(shown._content.content)
        buttons = shown._buttons._buttons
        assert {*buttons} == {"A", "B"}
        for button in buttons.values():
            assert all(f'for="{name_of(button)}"' in content for content in told)
    finally:
        server.stop()


def test_a_click_on_a_path_selects_its_group_whichever_is_first_by_then():
    cabin, heard, firsts, buttons = mounted_cabin(), Listener(), [], set()
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    state = first_state(cabin, cabin.rates, Conditions("rough", 20.0))
    try:
        with closing(Session(cabin, state, heard)) as session:
            panel = PathsPanel(server.gui, session)
            session.start()
            for hz in (2.0, 30.0):
                session.do(ChangeCharts(paths_by="group", cursor_hz=hz))
                assert session.wait(20)
                panel.show(heard.answers[-1])
                labels = re.findall(r'for="([^"]*)"><[^>]*>([AB])\b', panel._content.content)
                firsts.append(labels[0][1])
                buttons.update(labels)
    finally:
        server.stop()
    assert firsts == ["A", "B"]
    assert len(buttons) == 2
