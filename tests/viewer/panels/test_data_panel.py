"""Files of the tab Pictures: those that the command line writes, of what is on the screen."""

from dataclasses import replace

import pytest
from cabin_session import SOON
from mounted_cabin import mounted_cabin
from session_commands import Alter

from modeviz.cli.options import RoadOptions
from modeviz.export.solution import ExportOptions
from modeviz.study.study import Study
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.bodies import Material, MeshPart
from modeviz.vehicle.connections import Tyre
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.panels.data_files import CONTENTS, _choices

RATES = {"A": mounted_cabin().rate_sets["soft"]["A"]}


def cabin():
    """With a triangle for each body."""
    vehicle = mounted_cabin()
    part = MeshPart("t", [[1.0, 0, 1], [1, 1, 1], [2, 0, 1]], [[0, 1, 2]], Material((9, 9, 9)))
    return replace(vehicle, bodies=tuple(replace(b, mesh=(part,)) for b in vehicle.bodies))


@pytest.fixture(scope="module")
def app():
    vehicle, conditions = RoadOptions().shown(cabin())
    server = open_server(port=0, token="open-sesame-open")
    app = App(vehicle, vehicle.rates, conditions, server)
    app.start()
    app.session.do(Alter(rates=vehicle.all_rates(RATES)))
    assert app.session.wait(SOON)
    yield app
    app.close()


@pytest.mark.parametrize(
    ("content", "kind"),
    [(content, kind) for content, kinds in _choices(cabin()).items() for kind in kinds],
)
def test_every_file_is_the_one_that_a_study_writes(app, tmp_path, content, kind):
    panel = app.screen.controls.data
    file = panel._choices[content][kind]
    name, made = panel._made(file, ExportOptions(), None, lambda *_: None)
    assert name == f"cabin-soft-{file.word}.{file.ending}"
    study = Study(cabin())
    study.rates.use(RATES)
    shown = app.session.answer.followed.name.name
    written = study.export(tmp_path / name, mode=shown).path.read_bytes()
    is_solved = file.word in ("modes", "complex-modes", "motion", "psd", "frf")  # to their last digits
    assert made[: 100 if is_solved else None] == written[: 100 if is_solved else None]
    assert len(made) == pytest.approx(len(written), rel=0.01)


def test_formats_are_those_of_the_content_and_one_stays_where_it_can(app):
    panel = app.screen.controls.data
    panel._content.value = "Modes"
    panel._offer()
    panel._format.value = "ParaView, VTU"
    panel._content.value = "All bodies"
    panel._offer()
    assert panel._format.value == "ParaView, VTU"
    assert panel._format.options == ("ParaView, VTU", "glTF, GLB")
    panel._content.value = "Mounts"
    panel._offer()
    assert panel._format.value == "CSV"
    assert not panel._units.visible
    panel._format.value = "Nastran cards"
    panel._show_units()
    assert panel._units.visible


def test_what_a_vehicle_lacks_is_not_offered():
    bare = replace(
        cabin(),
        mount_groups=(),
        rate_sets={},
        response_points=(),
        roads=(),
        wheel_loads=(),
        connections=tuple(c for c in cabin().connections if isinstance(c, Tyre)),
    )
    offered = set(_choices(bare))
    assert offered & set(CONTENTS) == {
        "Modes",
        "Modes with damping",
        "Motion of the mode shown",
        "All bodies",
        "Vehicle folder",
    }
    assert {"Cab", "Chassis"} <= offered


def test_the_mass_of_an_absorber_is_no_body_to_be_written():
    tva = Absorber("tva", "cab", (1.0, 0.2, 1.4), 6.0, 12.0, 0.1)
    assert _choices(with_absorbers(cabin(), [tva])).keys() == _choices(cabin()).keys()
