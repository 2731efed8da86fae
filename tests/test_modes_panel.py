"""What the tables of modes and of energy say, on the cabin on mounts."""

import re
from dataclasses import replace
from html import unescape

import numpy as np
import pytest
import viser
from mounted_cabin import mounted_cabin

from modeviz.tuning.results import Conditions
from modeviz.vehicle.connections import MountRates
from modeviz.vehicle.files import builtin_vehicle, read_vehicle
from modeviz.viewer.panels.energy import MOVES_FREELY, EnergyPanel
from modeviz.viewer.panels.modes import NONE_LISTED, ModesPanel, scale
from modeviz.viewer.panels.side_by_side import side_by_side
from modeviz.viewer.session import Session
from modeviz.viewer.state import first_state

SOFTER = {"A": MountRates(6e5, 2e5, 3e5)}


@pytest.fixture(scope="module")
def gui():
    server = viser.ViserServer(port=0, verbose=False)
    yield server.gui
    server.stop()


@pytest.fixture
def answer():
    """Answers of a session to rates."""
    vehicle = mounted_cabin()
    answers, failures, sessions = [], [], []

    def answer(rates, vehicle=vehicle, **fields):
        state = first_state(vehicle, vehicle.rates, Conditions("flat", 20.0))
        session = Session(vehicle, replace(state, **fields), answers.append, failures.append)
        sessions.append(session)
        session.start()
        session.set_rates(rates)
        assert session.wait(20)
        return session, answers[-1]

    yield answer
    for session in sessions:
        session.close()
    assert not failures


def rows(html, kind):
    """The texts of the cells of the tables of a kind."""
    tables = re.findall(rf'<table class="{kind}">(.*?)</table>', html)
    found = [
        re.findall(r"<t[dh]>(.*?)</t[dh]>", r) for t in tables for r in re.findall("<tr.*?</tr>", t)
    ]
    return [[unescape(re.sub("<[^>]*>", "", cell)).strip() for cell in cells] for cells in found]


def modes_table(gui, session, solved):
    panel = ModesPanel(gui, session)
    panel.show(solved)
    return panel._content.content


def test_the_modes_table_gives_frequency_change_and_damping(gui, answer):
    session, solved = answer(SOFTER)
    header, *lines = rows(modes_table(gui, session, solved), "modes")
    assert header == ["Mode", "Hz", "Δ Hz", "ζ %", "moves most"]
    (yaw,) = [cells for cells in lines if cells[0] == "Cab yaw"]
    i, before = solved.now.mode_index("cab yaw"), solved.base.mode_index("cab yaw")
    f, old = solved.now.modes.frequency_hz[i], solved.base.modes.frequency_hz[before]
    assert f < old - 0.1
    assert yaw[1:4] == [
        f"{f:.2f}",
        f"−{old - f:.2f}",
        f"{100 * solved.now.modes.damping_ratio[i]:.1f}",
    ]
    assert yaw[4] == f"cab {100 * solved.now.kinetic_energy['cab'][i]:.0f} %"


def test_everything_is_against_the_set_compared_with(gui, answer):
    session, solved = answer({}, against="Soft")
    html = modes_table(gui, session, solved)
    (yaw,) = [cells for cells in rows(html, "modes") if cells[0] == "Cab yaw"]
    soft = solved.base.modes.frequency_hz[solved.base.mode_index("cab yaw")]
    own = solved.now.modes.frequency_hz[solved.mode]
    assert yaw[2] == f"+{own - soft:.2f}"
    assert f"Cab yaw {soft:.2f} → {own:.2f} Hz" in html
    assert "Soft" in html
    assert "riginal" not in html


@pytest.fixture
def stiffer(answer):
    """The built-in truck with C1 at 1900 N/mm vertical and 1905 N/mm lateral."""
    truck = read_vehicle(builtin_vehicle())
    rates = {"C1": replace(truck.rates["C1"], vertical=1.9e6, lateral=1.905e6)}
    return answer(rates, truck, conditions=Conditions("road 1", truck.speed))


def test_namesakes_are_compared_by_shape_and_what_has_no_partner_says_what_it_was(gui, stiffer):
    """From the shapes alone: see the MACs of `test_pairing`."""
    html = modes_table(gui, *stiffer)
    changes = {(cells[0], cells[1]): cells[2] for cells in rows(html, "modes")}
    assert changes["Rear axle fore-aft", "17.88"].strip("+−") == "0.00"
    assert changes["~Front wheels yaw 2", "20.26"] == "~+0.41"
    assert changes["~Front wheels yaw", "18.98"] == changes["~Cab fore-aft", "15.19"] == "–"
    assert changes["~Cab yaw", "12.17"] == "+0.48"
    assert "its shape was the cab roll of Original, 17.34 Hz" in html
    assert "its shape was the rear axle fore-aft of Original, 15.12 Hz" in html
    assert "new" not in changes.values()


def test_side_by_side_compares_the_same_modes_as_the_table(stiffer):
    html = side_by_side(stiffer[1])
    found = rows(html, "")
    assert ["~Front wheels yaw", "–", "18.98", "–"] in found
    assert ["~Front wheels yaw 2", "19.84", "20.26", "~+0.41"] in found
    assert ["~Rear axle fore-aft", "15.12", "–", ""] in found
    assert not any("17.88" in cells for cells in found)


def test_the_ladder_spans_what_the_mounts_hold(answer):
    # Above 10 Hz the cab moves on its mounts, below 6 Hz everything moves on its tyres.
    assert scale(answer({})[1].base) == (10, 20)


def test_the_ladder_stands_still_while_rates_move(answer):
    assert scale(answer(SOFTER)[1].base) == scale(answer({})[1].base)


def test_a_vehicle_without_modes_in_the_band_is_told_what_to_do(gui, answer):
    stiff = mounted_cabin()
    groups = tuple(replace(g, rates=MountRates(1e9, 1e9, 1e9)) for g in stiff.mount_groups)
    tyres = tuple(replace(t, stiffness=100 * t.stiffness) for t in stiff.connections)
    stiff = replace(stiff, mount_groups=groups, connections=tyres)
    session, solved = answer({}, stiff)
    assert NONE_LISTED in modes_table(gui, session, solved)


def energy(gui, session, solved):
    panel = EnergyPanel(gui, session)
    panel.show(solved)
    return panel._content.content


def test_energy_is_given_now_and_before_and_adds_up(gui, answer):
    session, solved = answer(SOFTER)
    table = rows(energy(gui, session, solved), "energy")
    before = solved.base.mode_index("cab yaw")
    assert ["Cab", "", "", ""] not in table
    for name, label in (("cab", "Cab"), ("chassis", "Chassis")):
        (line,) = [cells for cells in table if cells[0] == label]
        now, base = (
            r.kinetic_energy[name][i] for r, i in ((solved.now, solved.mode), (solved.base, before))
        )
        assert line[2:] == [f"{100 * now:.0f} %", f"{100 * base:.0f} %"]
    strain = {cells[0]: cells[2] for cells in table if cells[0] not in ("Cab", "Chassis")}
    assert list(strain) == ["A front", "B rear", "Tyres"]
    assert sum(int(share.split()[0]) for share in strain.values()) == pytest.approx(100, abs=1.5)


def test_the_selected_group_is_marked_and_the_others_can_be_clicked(gui, answer):
    session, solved = answer({}, group="B")
    html = energy(gui, session, solved)
    (chosen,) = re.findall('<tr class="on">(.*?)</tr>', html)
    assert "B <" in chosen
    assert html.count("<label") == 2


def test_a_mode_that_moves_freely_says_what_to_do(gui, answer):
    loose = mounted_cabin()
    tyres = tuple(replace(t, stiffness=np.zeros(3)) for t in loose.connections)
    session, solved = answer({}, replace(loose, connections=tyres))
    session.show_mode(solved.now.names[0].name)
    assert session.wait(20)
    assert MOVES_FREELY in energy(gui, session, session._last)
