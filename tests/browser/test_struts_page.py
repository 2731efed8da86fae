"""The rates of dampers and those about axes on the page, moved as an engineer would."""

import numpy as np
import pytest
from apps import open_app
from cab_on_struts import cab_on_struts
from mount_controls import box, drag, open_folder, position, thumb, type_rate
from pages import wait_for, wait_until

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.files.folder import read_vehicle, write_vehicle
from modeviz.viewer.session.commands.looks import SelectGroup

SOLVE_S = 60
LOAD = Conditions("shaking frame", 20.0)
FRONT_DAMPING, REAR_ABOUT_Z = 3, 3
"""Numbers of these rates among those of their groups."""


@pytest.fixture(scope="module")
def app(server, tmp_path_factory):
    vehicle = cab_on_struts(tmp_path_factory.mktemp("vehicle") / "cab")
    with open_app(server, vehicle, LOAD) as app:
        app.start()
        assert app.session.wait(SOLVE_S)
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(980, 640))
    wait_for(page, "document.querySelectorAll('.mv-rates').length === 3")
    return page


def rate(app, group, field):
    return getattr(app.session.state.design.rates[group], field)


def test_sliders_of_dampers_and_about_axes_give_what_a_folder_with_such_rates_gives(
    app, page, tmp_path
):
    before = app.session.answer.now
    open_folder(page, "F")
    drag(page, thumb(page, "F", FRONT_DAMPING), position(thumb(page, "F", FRONT_DAMPING)) + 40)
    wait_until(page, lambda: rate(app, "F", "damping_vertical") > 2200.0)
    number = f"{rate(app, 'F', 'damping_vertical'):g}"
    wait_until(page, lambda: box(page, "F", FRONT_DAMPING).input_value() == number)
    open_folder(page, "R")
    drag(page, thumb(page, "R", REAR_ABOUT_Z), position(thumb(page, "R", REAR_ABOUT_Z)) + 60)
    wait_until(page, lambda: rate(app, "R", "rz") > 1200.0)
    open_folder(page, "D")
    type_rate(page, "D", 0, "3000")
    wait_until(page, lambda: rate(app, "D", "damping_vertical") == 3000.0)
    assert app.session.wait(SOLVE_S)

    write_vehicle(app.session.vehicle.with_rates(app.session.state.design.rates), tmp_path / "cab")
    fresh = solve(prepare(read_vehicle(tmp_path / "cab")), {}, LOAD)
    now = app.session.answer.now
    n = len(fresh.modes.frequency_hz)
    assert now.modes.frequency_hz[:n] == pytest.approx(fresh.modes.frequency_hz, rel=1e-9)
    assert now.modes.damping_ratio[:n] == pytest.approx(fresh.modes.damping_ratio, rel=1e-9)
    assert now.rms == pytest.approx(fresh.rms, rel=1e-6)
    assert np.abs(now.rms / before.rms - 1).max() > 0.01
    assert now.modes.damping_ratio.max() > 1.1 * before.modes.damping_ratio.max()


def test_dampers_have_their_units_locks_and_ways_back(app, page):
    page.get_by_role("combobox", name="Damping in").click()
    page.get_by_role("option", name="N s/mm").click()
    app.session.do(SelectGroup("D"))
    open_folder(page, "D")
    wait_until(page, lambda: box(page, "D", 0).input_value() == "3")
    page.get_by_title("Back to Original", exact=True).locator("visible=true").click()
    wait_until(page, lambda: rate(app, "D", "damping_vertical") == 1900.0)
    page.get_by_title("Lock: only loading a set moves it then").locator("visible=true").click()
    wait_until(page, lambda: app.session.state.design.locked == {("D", "damping_vertical")})
    wait_until(page, lambda: box(page, "D", 0).is_disabled())
