"""The words on the page are a reader's, not the program's."""

import re

import pytest
from mounted_cabin import mounted_cabin

from modeviz.analysis.results import Conditions
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server

OF_THE_PROGRAM = re.compile(r"[a-z][A-Z]\w*[a-z]{2}|\b[a-z]+_[a-z]+\b")
"""CamelCase and snake_case, but not "kN/mm"."""


@pytest.fixture
def words():
    """Labels, choices and hints of all controls."""
    vehicle = mounted_cabin()
    server = open_server(port=0, token="open-sesame-open")
    app = App(vehicle, vehicle.rates, Conditions("flat", 20.0), server)
    found = []
    for handle in server.gui._gui_input_handle_from_uuid.values():
        props = vars(handle._impl.props)
        found += [props.get("label"), props.get("_hint"), *props.get("options", ())]
    app.close()
    return [word for word in found if word]


def test_no_control_is_called_by_a_name_of_the_program(words):
    assert len(words) > 100
    assert {"Goal", "Rates in", "Vertical"} <= set(words)
    assert not [word for word in words if OF_THE_PROGRAM.search(word)]
