"""Where the form for absorbers puts one, and that it follows the mode shown until somebody chooses."""

import numpy as np
from mounted_cabin import mounted_cabin
from opened_app import SOON
from visitors import entered, update, wait_until

from modeviz.analysis.absorbers import effective_mass
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.mount_rates import DIRECTIONS
from modeviz.viewer.panels.mounts.absorber_draft import ALONG, AbsorberDraft, places
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.commands.looks import ShowMode


def proposal_for(app, mode):
    app.session.do(ShowMode(mode, mounted_cabin().rates))
    solved = app.session.wait_for_answer(SOON)
    assert solved.followed.name.name == mode
    return app.screen.controls.mounts._form._proposal, solved


def test_it_opens_where_the_mode_shown_moves_most_and_follows_it_until_somebody_chooses(opened):
    app = opened(mounted_cabin())
    form = app.screen.controls.mounts._form
    vehicle, modes = mounted_cabin(), [name.name for name in app.session.answer.now.names]
    shown = [name for name in modes if not name.startswith("free")][-4:]
    for name in shown:
        proposal, solved = proposal_for(app, name)
        shares = solved.now.kinetic_energy
        mode = solved.followed.mode
        assert shares[proposal.body][mode] == max(share[mode] for share in shares.values())
        every = [
            effective_mass(solved.now, mode, proposal.body, np.array(place), (direction,))
            for place in places(vehicle, proposal.body).values()
            for direction in DIRECTIONS
        ]
        assert proposal.moved == min(every)
        assert proposal.share == np.float64(proposal.mass / proposal.moved)
        assert form._at.value in places(vehicle, proposal.body)
    form._put(AbsorberDraft("chassis"))
    chosen = [proposal_for(app, name)[0].body for name in shown]
    assert chosen == ["chassis"] * len(shown)
    form._put_at((1.0, 0.0, 0.5))
    assert {proposal_for(app, name)[0].position for name in shown} == {(1.0, 0.0, 0.5)}


def test_what_is_typed_and_chosen_in_it_is_taken_and_the_page_goes_on(opened):
    app = opened(mounted_cabin())
    form = app.screen.controls.mounts._form
    _, _, place, along, kilograms, _ = (binding._widget for binding in form._bindings)
    with entered(app.server) as page:
        page.send(update(place, (700.0, 0.0, 500.0)))
        wait_until(lambda: form.state.position == (0.7, 0.0, 0.5))
        other = next(option for option in along.options if option != along.value)
        page.send(update(along, other))
        wait_until(lambda: form.state.directions == ALONG[other])
        page.send(update(kilograms, 5.0))
        wait_until(lambda: form.state.mass == 5.0)
        app.session.do(SetRate("A", "vertical", 4e5))
        assert app.session.wait(SOON)
        assert place.value == (700.0, 0.0, 500.0)
        assert kilograms.value == 5.0


def test_its_rates_have_no_more_digits_than_their_boxes_have_room_for(opened):
    app = opened(mounted_cabin())
    app.screen.controls.mounts._form._add(None)
    assert app.session.wait(SOON)
    (absorber,) = app.session.state.design.alterations.absorbers
    for row in app.screen.controls.mounts._folders[absorber.name]._rows.values():
        shown = row._number.value
        assert shown == float(f"{shown:.4g}") > 0
        assert "%" not in row._slider.label


def test_a_rate_of_many_digits_is_shown_to_four_and_stays_what_it_is(opened):
    app = opened(mounted_cabin())
    app.session.do(SetRate("A", "vertical", 139312.345))
    row = app.screen.controls.mounts._folders["A"]._rows["vertical"]
    assert row._in_unit(app.session.state) == 139.3
    row._type(139.3)
    assert app.session.state.design.rates["A"].vertical == 139312.345
    row._type(139.25)
    assert app.session.state.design.rates["A"].vertical == 139250
    assert row._in_unit(app.session.state) == 139.25


def test_of_an_absorber_of_the_file_its_mass_and_motion_are_said(opened):
    tva = Absorber("tva", "cab", (1.0, 0.2, 1.4), 6.25, 12.0, 0.08)
    app = opened(with_absorbers(mounted_cabin(), [tva]))
    assert app.session.wait(SOON)
    text = app.screen.controls.mounts._folders["tva"]._absorber._text
    assert "6.25 kg, as in the vehicle's file" in text.content
    assert "12.00 Hz vertical, 8.0 % of critical" in text.content
    assert app.screen.controls.mounts._folders["A"]._absorber is None
