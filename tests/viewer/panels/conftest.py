import pytest
from opened_app import opened_app

from modeviz.cli.options import RoadOptions


@pytest.fixture
def opened():
    """Opens the whole pages of vehicles, and closes them after the test."""
    apps = []

    def open_page(vehicle):
        apps.append(opened_app(*RoadOptions().shown(vehicle)))
        return apps[-1]

    yield open_page
    for app in apps:
        app.close()
