"""An absorber added on the page, tuned, removed and brought back."""

import numpy as np
import pytest
from apps import SOLVE_S, open_solved_cabin
from mount_controls import open_folder, type_rate
from mounted_cabin import mounted_cabin
from pages import CLOSE_NOTICES, wait_for, wait_until

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import solve
from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.alterations import altered

NAME = "absorber 1"
N_FOLDERS = "document.querySelectorAll('.mv-rates').length"
BLOCK = f"window.__viserSceneTree.getState()['/vehicle/{NAME} mass']?.effectiveVisibility === true"


@pytest.fixture(scope="module")
def app(server):
    with open_solved_cabin(server) as app:
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(1280, 800))
    wait_for(page, f"{N_FOLDERS} === 2")
    page.evaluate(CLOSE_NOTICES)
    return page


def test_an_absorber_is_added_tuned_removed_and_brought_back(app, page, tmp_path):
    before = app.session.state.design
    page.get_by_text("Add an absorber", exact=True).click()
    page.get_by_role("button", name="Add absorber", exact=True).click()
    wait_for(page, f"{N_FOLDERS} === 3 && {BLOCK}")
    assert app.session.state.group == NAME
    (absorber,) = app.session.state.design.alterations.absorbers

    open_folder(page, NAME)
    type_rate(page, NAME, "vertical", "400")  # of its one direction
    wait_until(page, lambda: app.session.state.design.rates[NAME].lateral == 4e5)
    solved = app.session.wait_for_answer(SOLVE_S)
    design = solved.state.design
    tuned = altered(mounted_cabin(), design.alterations).with_rates(design.rates)
    write_vehicle(tuned, tmp_path / "with it")
    fresh = solve(prepare(read_vehicle(tmp_path / "with it")), {}, solved.now.conditions)
    np.testing.assert_allclose(solved.now.modes.frequency_hz, fresh.modes.frequency_hz, rtol=1e-8)
    np.testing.assert_allclose(
        solved.now.psd, fresh.psd, rtol=1e-6, atol=1e-9 * np.abs(fresh.psd).max()
    )

    page.get_by_role("button", name="Remove absorber", exact=True).click()
    wait_for(page, f"{N_FOLDERS} === 2 && !({BLOCK})")
    assert app.session.state.design == before
    page.get_by_role("button", name="Undo", exact=True).click()
    wait_for(page, f"{N_FOLDERS} === 3 && {BLOCK}")
    assert app.session.state.design.alterations.absorbers == (absorber,)
    assert app.session.state.design.rates[NAME].lateral == 4e5
