"""What the tables of modes and of energy say, on the cabin on mounts."""

import re
from dataclasses import replace
from html import unescape

import numpy as np
import pytest
import viser
from mounted_cabin import mounted_cabin
from session_commands import Listener, altered

from modeviz.analysis.results import Conditions
from modeviz.dynamics.tracking import WEAK_MAC
from modeviz.text.wording import sentence_case, signed
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.panels.energy import MOVES_FREELY, EnergyPanel
from modeviz.viewer.panels.ladder import MARGIN
from modeviz.viewer.panels.modes import NONE_LISTED, ModesPanel, scale
from modeviz.viewer.panels.side_by_side import side_by_side
from modeviz.viewer.session.commands.decisions import TakeRates
from modeviz.viewer.session.commands.looks import ShowMode
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import first_state

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
    sessions = []

    def answer(rates, vehicle=vehicle, **fields):
        state = first_state(vehicle, vehicle.rates, Conditions("flat", 20.0))
        heard = Listener()
        session = Session(vehicle, altered(state, **fields), heard)
        sessions.append((session, heard))
        session.start()
        session.do(TakeRates(rates))
        assert session.wait(20)
        return session, heard.answers[-1]

    yield answer
    for session, heard in sessions:
        session.close()
        assert not heard.failures


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
    own = solved.now.modes.frequency_hz[solved.followed.mode]
    assert yaw[2] == f"+{own - soft:.2f}"
    assert f"Cab yaw {soft:.2f} → {own:.2f} Hz" in html
    assert "Soft" in html
    assert "riginal" not in html


TWO_LATERAL = {"A": MountRates(4.49e5, 1.2e4, 4.2e4), "B": MountRates(2.21e5, 3.5e5, 2.4e4)}
"""There is a "cab lateral" and a "cab lateral 2", which is like the only one before in part."""


def frequency(results, name):
    return results.modes.frequency_hz[results.mode_index(name)]


def test_namesakes_are_compared_by_shape_and_what_has_no_partner_says_what_it_was(gui, answer):
    session, solved = answer(TWO_LATERAL)
    base, now = solved.base, solved.now
    html = modes_table(gui, session, solved)
    changes = {cells[0]: cells[2] for cells in rows(html, "modes")}
    moved = frequency(now, "cab lateral 2") - frequency(base, "cab lateral")
    assert changes["~Cab lateral 2"] == f"~{signed(moved, 2)}"
    tramp = new_in(solved)
    assert changes["~Cab lateral"] == changes[sentence_case(now.names[tramp].spoken)] == "–"
    was = f"its shape was in part the roll of Original, {frequency(base, 'roll'):.2f} Hz"
    assert f"Nothing there moves like this; {was}" in html
    sources = [base.names[i].name for i, _ in solved.followed.track.sources(tramp)]
    both = (f"the {n} of Original, {frequency(base, n):.2f} Hz" for n in sources)
    assert len(sources) > 1
    assert f"its shape was in part {' and '.join(both)}" in html


def new_in(solved):
    """The tramp that an axle has only now."""
    (mode,) = [i for i, n in enumerate(solved.now.names) if n.motion.endswith("tramp")]
    assert not any(n.motion.endswith("tramp") for n in solved.base.names)
    return mode


def test_side_by_side_compares_the_same_modes_as_the_table(answer):
    _, solved = answer(TWO_LATERAL)
    found = {cells[0]: cells[1:] for cells in rows(side_by_side(solved), "")}
    old, first, second = (
        f"{frequency(results, name):.2f}"
        for results, name in (
            (solved.base, "cab lateral"), (solved.now, "cab lateral"), (solved.now, "cab lateral 2")
        )
    )  # fmt: skip
    assert found["~Cab lateral"] == ["–", first, "–"]
    assert found["~Cab lateral 2"][:2] == [old, second]
    gone = solved.base.names[solved.base.mode_index("cab fore-aft")].spoken
    new = sentence_case(solved.now.names[new_in(solved)].spoken)
    assert found[new][0] == found[sentence_case(gone)][1] == "–"


def rails(html):
    """(from, to, dashed) of each, percent."""
    found = re.findall(r'<line x1="([\d.]+)%" y1="8" x2="([\d.]+)%" y2="44"([^>]*)>', html)
    return [(float(a), float(b), "dasharray" in more) for a, b, more in found if "soft" not in more]


def test_a_shape_that_several_modes_share_is_joined_to_each_of_them(gui, answer):
    session, solved = answer(TWO_LATERAL)
    track = solved.followed.track
    low, high = scale(solved.base)

    def x(f):
        return MARGIN + (100 - 2 * MARGIN) * (min(max(f, low), high) - low) / (high - low)

    f, f_now = solved.base.modes.frequency_hz, solved.now.modes.frequency_hz
    expected = [
        (x(f[i]), x(f_now[j]), float(share < WEAK_MAC))
        for i in range(len(f))
        for j, share in track.holders(i)
        if low <= f[i] <= high or low <= f_now[j] <= high
    ]
    found = rails(modes_table(gui, session, solved))
    np.testing.assert_allclose(np.sort(found, axis=0), np.sort(expected, axis=0), atol=0.006)
    assert len(found) > len({a for a, _, _ in found})


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
            r.kinetic_energy[name][i]
            for r, i in ((solved.now, solved.followed.mode), (solved.base, before))
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
    session.do(ShowMode(solved.now.names[0].name))
    assert session.wait(20)
    assert MOVES_FREELY in energy(gui, session, session.answer)
