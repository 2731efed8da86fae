"""Files that a page sends are kept apart from everything else on this machine."""

from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from crg_files import crg
from network_files import network_unv

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.viewer.inspection import putting
from modeviz.viewer.inspection import received as module
from modeviz.viewer.inspection.putting import Asked, component_in, put
from modeviz.viewer.inspection.received import Received


@pytest.fixture
def received():
    received = Received()
    yield received
    received.close()


def component(received):
    with received.told() as paths:
        return component_in(paths)


DECK = "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nPLOTEL,1,1,2\n{}\nENDDATA\n"


def test_what_came_is_read(received):
    received.add("network.unv", network_unv().encode())
    assert component(received).n_modes == 24
    assert received.names == ("network.unv",)


def test_a_file_that_another_includes_is_found_among_what_came(received):
    received.add("more.inc", b"GRID,3,,0.,1.,0.\n")
    received.add("deck.bdf", DECK.format("INCLUDE 'more.inc'").encode())
    assert component(received).node_ids.tolist() == [1, 2, 3]


@pytest.mark.parametrize("way", ["{outside}", "../{name}", "link/secret.inc"])
def test_nothing_else_on_this_machine_is_read(received, tmp_path, way):
    secret = tmp_path / "secret.inc"
    secret.write_text("GRID,99,,7.,7.,7.\n", encoding="utf-8")
    name = f"{tmp_path.parent.name}/{tmp_path.name}/secret.inc"
    included = way.format(outside=secret, name=name)
    received.add("deck.bdf", DECK.format(f"INCLUDE '{included}'").encode())
    with suppress(VehicleError):
        assert component(received).node_ids.tolist() == [1, 2]


@pytest.mark.parametrize("name", ["../../up.unv", "/there/up.unv", "..\\up.unv"])
def test_a_name_with_a_way_is_only_a_name(received, name):
    received.add(name, network_unv().encode())
    assert received.names == ("up.unv",)


def test_messages_do_not_say_where_files_are_kept(received):
    received.add("broken.unv", b"nothing")
    with pytest.raises(VehicleError, match=r"^broken\.unv: "):
        component(received)


@pytest.mark.parametrize("name", ["", "..", "/"])
def test_a_file_has_a_name(received, name):
    with pytest.raises(VehicleError, match="without a name"):
        received.add(name, b"")


def test_files_and_bytes_are_bounded(received, monkeypatch):
    monkeypatch.setattr(module, "MOST_FILES", 2)
    monkeypatch.setattr(module, "MOST_BYTES", 10)
    received.add("a.unv", b"12345")
    received.add("b.unv", b"12345")
    received.add("b.unv", b"54321")
    with pytest.raises(VehicleError, match=r"c\.unv: is one more than 2 files"):
        received.add("c.unv", b"")
    with pytest.raises(VehicleError, match=r"b\.unv: with the others more than"):
        received.add("b.unv", b"123456")


def test_without_a_file_of_a_format_it_says_which_there_are(received):
    received.add("notes.md", b"hello")
    with pytest.raises(VehicleError, match=r"no file to read yet, expected one of .*\.op2"):
        component(received)


def test_all_are_deleted_in_the_end():
    received = Received()
    received.add("a.unv", b"1")
    folder = received._folder.name
    received.close()
    assert not module.Path(folder).exists()


MOUNTS = """name,body 1,body 2,x [mm],y [mm],z [mm],kx [N/mm],ky [N/mm],kz [N/mm],property
one,network,ground,0,0,0,{rates},{property}
"""


@pytest.fixture
def vehicle(received, tmp_path):
    """A folder with the network as its one body."""
    folder = tmp_path / "vehicle"
    received.add("network.unv", network_unv().encode())
    with received.told() as paths:
        put(paths, Asked(name="network", units="mm-t-s", attach=("corner=11",)), folder)
    received.clear()
    return folder


def test_a_mount_table_becomes_mounts_of_the_vehicle(received, vehicle):
    received.add("mounts.csv", MOUNTS.format(rates="1,2,3", property="").encode())
    with received.told() as paths:
        assert component_in(paths) is None
        assert put(paths, Asked(), vehicle).what == "1 connections"
    (connection,) = read_vehicle(vehicle).all_connections
    np.testing.assert_allclose(connection.stiffness, [1e3, 2e3, 3e3])


def test_a_body_takes_the_place_of_that_of_its_name_if_it_is_asked_to(received, vehicle):
    received.add("network.unv", network_unv().encode())
    asked = Asked(name="network", units="mm-t-s", attach=("corner=11", "other=14"))
    with received.told() as paths:
        with pytest.raises(VehicleError, match="already; put this one in its place with --replace"):
            put(paths, asked, vehicle)
        put(paths, replace(asked, replace=True), vehicle)
    (body,) = read_vehicle(vehicle).bodies
    assert [a.name for a in body.attachments] == ["corner", "other"]


def test_mounts_take_no_bodys_place(received, vehicle):
    received.add("mounts.csv", MOUNTS.format(rates="1,2,3", property="").encode())
    with (
        pytest.raises(VehicleError, match="--replace: has no effect on mounts"),
        received.told() as paths,
    ):
        put(paths, Asked(replace=True), vehicle)


@pytest.mark.parametrize("way", ["../secret.gbs", "{outside}"])
def test_a_mount_table_reads_no_property_file_elsewhere(received, vehicle, tmp_path, way):
    secret = tmp_path / "secret.gbs"
    secret.write_text("$---\n[UNITS]\n(SECRET)\n", encoding="utf-8")
    named = way.format(outside=secret)
    received.add("mounts.csv", MOUNTS.format(rates=",,", property=named).encode())
    before = (vehicle / "vehicle.toml").read_bytes()
    with pytest.raises(VehicleError) as error, received.told() as paths:
        put(paths, Asked(), vehicle)
    assert "SECRET" not in str(error.value)
    assert (vehicle / "vehicle.toml").read_bytes() == before


def test_mounts_are_read_among_what_came_whatever_looked_at_them_before(
    received, vehicle, tmp_path, monkeypatch
):
    monkeypatch.setattr(putting, "component_in", lambda paths: None)
    outside = tmp_path / "springs.inc"
    outside.write_text("CBUSH,1,1,11,,,,,0\nPBUSH,1,K,5.,5.,5.\n", encoding="utf-8")
    received.add("deck.bdf", f"BEGIN BULK\nGRID,11,,0.,0.,0.\nINCLUDE '{outside}'\nENDDATA\n".encode())
    with pytest.raises(VehicleError, match="in another folder"), received.told() as paths:
        put(paths, Asked(units="mm-t-s"), vehicle)


@pytest.mark.parametrize("text", ["{table}", "corner={table}", "{table}/"])
def test_a_residual_compliance_is_no_table_on_this_machine(received, tmp_path, text):
    table = tmp_path / "secret.csv"
    table.write_text("attachment,x,y,z\ncorner,1,1,1\n", encoding="utf-8")
    received.add("network.unv", network_unv().encode())
    asked = Asked(name="a", units="mm-t-s", attach=("corner=11",), residual=(text.format(table=table),))
    with pytest.raises(VehicleError, match="expected NAME=X,Y,Z"), received.told() as paths:
        put(paths, asked, tmp_path / "vehicle")
    assert not (tmp_path / "vehicle").exists()


def test_a_residual_compliance_is_kept(received, tmp_path):
    received.add("network.unv", network_unv().encode())
    given = ("corner=0.001,0,0",)
    asked = Asked(name="a", units="mm-t-s", attach=("corner=11",), residual=given)
    with received.told() as paths:
        put(paths, asked, tmp_path / "vehicle")
    (body,) = read_vehicle(tmp_path / "vehicle").bodies
    np.testing.assert_allclose(body.residual_compliance("corner")[0, 0], 1e-6, rtol=1e-6)


def test_mounts_that_wait_go_when_a_body_comes(received):
    received.add("mounts.csv", MOUNTS.format(rates="1,2,3", property="").encode())
    received.add("network.unv", network_unv().encode())
    assert received.names == ("network.unv",)


def test_a_table_of_nodes_waits_for_its_matrices(received):
    received.add("nodes.csv", b"node,x,y,z\n1,0,0,0\n")
    received.add("K.mtx", b"%%MatrixMarket\n")
    assert received.names == ("nodes.csv", "K.mtx")


@pytest.mark.parametrize("name", ["部" * 90 + ".unv", "a\0.unv", "\ud800.unv", "a\n.unv"])
def test_any_name_becomes_one_that_a_file_can_have(received, name):
    received.add(name, network_unv().encode())
    (kept,) = received.names
    assert kept.endswith(".unv")
    assert len(kept.encode()) <= module.LONGEST_NAME
    assert component(received).n_modes == 24


def test_what_a_deck_includes_from_elsewhere_does_not_decide_what_it_is(received, tmp_path):
    outside = tmp_path / "springs.inc"
    outside.write_text("CBUSH,1,1,11,,,,,0\nPBUSH,1,K,5.,5.,5.\n", encoding="utf-8")
    received.add("deck.bdf", DECK.format(f"INCLUDE '{outside}'").encode())
    with pytest.raises(VehicleError, match="in another folder"):
        component(received)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (Asked(name="a"), "--name: has no effect on mounts"),
        (Asked(attach=("1",)), "--attach: has no effect on mounts"),
        (Asked(residual=("1=1,1,1",)), "--residual: has no effect on mounts"),
        (Asked(pose="x=1,0,0"), "--pose: has no effect on a table of mounts"),
        (Asked(units="mm-t-s"), "--units: every column says its own unit"),
    ],
)
def test_what_would_do_nothing_to_mounts_is_refused(received, vehicle, asked, words):
    received.add("mounts.csv", MOUNTS.format(rates="1,2,3", property="").encode())
    with pytest.raises(VehicleError, match=words), received.told() as paths:
        put(paths, asked, vehicle)


@pytest.mark.parametrize("option", ["units", "attach", "residual", "pose", "replace"])
def test_what_would_do_nothing_to_a_road_is_refused(received, vehicle, option):
    heights = np.random.default_rng(3).uniform(-0.2, 0.2, (300, 3))
    received.add("road.crg", crg(heights, 0.1, [-1, 0, 1]))
    asked = Asked(**{option: "mm-t-s"})
    words = f"--{option}: has no effect on a road"
    with pytest.raises(VehicleError, match=words), received.told() as paths:
        put(paths, asked, vehicle)
