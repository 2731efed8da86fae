"""What the tab Static says of a load case, and that it follows rates and choices."""

import re
from dataclasses import replace

import numpy as np
import pytest
from engine_on_mounts import engine_on_mounts, limited_engine
from opened_app import SOON, text
from small_systems import block

from modeviz.text.wording import number
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.panels.statics import two_figures
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.commands.looks import ChangeMotion


def after(app, *commands):
    for command in commands:
        app.session.do(command)
    assert app.session.wait(SOON)
    return app.session.answer


def rows(app):
    """The cells of every row of the panel, as text."""
    found = re.findall(r"<tr[^>]*>(.*?)</tr>", app.screen.results.static._content.content)
    cells = (re.split(r"</?t[dh][^>]*>", row)[1::2] for row in found)
    return [[re.sub(r"<[^>]*>", "", cell).strip() for cell in row] for row in cells]


def test_the_panel_has_the_sag_and_the_forces_of_the_first_case(opened):
    app = opened(engine_on_mounts())
    assert ["Engine", "0.07", "0.05", "−1.24"] in [row[:4] for row in rows(app)]
    assert ["M1", "−15", "−4", "393", "0.08", "0.05", "−1.23"] in rows(app)
    assert "Travel" not in text(app.screen.results.static._content)


def test_rates_that_move_and_another_case_change_it(opened):
    app = opened(engine_on_mounts())
    solved = after(app, SetRate("M1", "vertical", 2e5), ChangeMotion(load_case="bump 3 g"))
    case = solved.static.now.case("bump 3 g")
    force, deflection = case.connections["M1"].force, case.connections["M1"].deflection
    (row,) = [row for row in rows(app) if row[0] == "M1"]
    assert row[3] == f"{force[2]:.0f}"
    assert row[6] == f"−{-1e3 * deflection[2]:.2f}"
    assert app.screen.results.static._case.value == "bump 3 g"


def test_travel_that_is_left_and_that_is_not_is_told(opened):
    app = opened(limited_engine())
    travel = {row[0]: row[1:] for row in rows(app) if len(row) == 5}
    assert travel["M1 vertical"] == ["−1.23", "−4.00", "2.00", "2.77 passed"]
    assert travel["M3 vertical"] == ["−1.59", "−1.00", "1.00", "−0.59 failed"]
    assert "it accelerates as a whole" in text(app.screen.results.static._content)


def test_a_case_that_nothing_holds_has_its_reason(opened):
    app = opened(limited_engine())
    after(app, ChangeMotion(load_case="push"))
    assert "Nothing holds 'loose' along z, so it falls" in text(app.screen.results.static._content)


def test_a_vehicle_that_nothing_holds_has_one_sentence(opened):
    app = opened(Vehicle("free", (block("block"),), ()))
    words = "Load case 'standing': nothing holds 'block' along z, so it falls and nothing is loaded"
    assert words in text(app.screen.results.static._content)
    assert rows(app) == []


def test_what_else_stands_on_the_ground_adds_up(opened):
    engine = engine_on_mounts()
    feet = limited_engine().connections
    held = replace(
        engine,
        connections=tuple(
            replace(foot, name=name, stiffness=np.full(3, 1e5))
            for foot, name in zip(feet * 2, "ab", strict=True)
        ),
    )
    app = opened(held)
    solved = app.session.answer.static.now.case("standing")
    total = sum(solved.connections[name].vehicle_force[:3] for name in "ab")
    assert rows(app)[-1] == ["sum", *(number(float(force), 0) for force in total)]


@pytest.mark.parametrize(
    ("scale", "said"), [(0.2512, "0.25"), (3.16, "3.2"), (18.4, "18"), (1387.0, "1400")]
)
def test_how_much_sag_is_exaggerated_has_two_figures(scale, said):
    assert two_figures(scale) == said
