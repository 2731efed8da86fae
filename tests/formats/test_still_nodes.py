"""Nodes that solvers hold since nothing is tied to them, such as those that turn a beam about."""

import numpy as np
import pytest
from free_network import MASSES
from network_files import network_unv

from modeviz.errors import VehicleError
from modeviz.formats.attachments import find_attachments
from modeviz.formats.body import flexible_body
from modeviz.formats.component import UNIT_SYSTEMS, Component, Modes
from modeviz.formats.places import parse_place
from modeviz.formats.universal import read_universal

UNITS = UNIT_SYSTEMS["mm-t-s"]


@pytest.fixture
def network(tmp_path):
    path = tmp_path / "a.unv"
    path.write_text(network_unv())
    return read_universal([path])


@pytest.fixture
def component(network):
    """The free network with a node 99 that no mode moves but by what rounding leaves."""
    modes = network.modes
    shapes = np.concatenate([modes.shapes, np.full((1, 6, 24), 1e-12)])
    more = Modes(modes.frequency_hz, modes.modal_mass, modes.damping_ratio, shapes)
    places = np.vstack([network.nodes, [[5e4, -3e4, 9e3]]])
    return Component(np.append(network.node_ids, 99), places, {}, more)


def test_a_body_is_what_it_is_without_them(network, component):
    at = parse_place("seat=11")
    (body, remarks), (other, _) = (
        flexible_body(one, UNITS, "network", find_attachments(one, [at], UNITS))
        for one in (component, network)
    )
    assert body.mass == pytest.approx(1000 * MASSES.sum(), rel=1e-6)
    scale = np.abs(other.attachments[0].shapes).max()
    difference = body.attachments[0].shapes - other.attachments[0].shapes
    np.testing.assert_allclose(difference, 0, atol=1e-9 * scale)
    assert any(remark.startswith("1 nodes stay where they are") for remark in remarks)
    assert len(body.nodes) == 8


def test_nothing_is_attached_to_them(component):
    found = find_attachments(component, [parse_place("seat=99")], UNITS)
    with pytest.raises(VehicleError, match="attachment 'seat': a node of it stays where it is"):
        flexible_body(component, UNITS, "network", found)
