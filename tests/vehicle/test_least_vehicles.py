"""Whatever is a vehicle goes through every command: with an answer, or one sentence and status 2."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import SOFT, STIFF, mounted_cabin
from oracles import Beam
from shared_preparations import shared_preparations

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.files import write_vehicle
from modeviz.vehicle.bodies import AddedMass, Material, MeshPart, RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Spring
from modeviz.vehicle.default_problem import default_problem
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import Performance
from modeviz.vehicle.vehicle import Vehicle

CABIN = mounted_cabin()
BEAM = Beam(6).body("beam", n_modes=14)
BOX = RigidBody("box", "cabin", "box", 100.0, np.array([0, 0, 0.5]), np.diag([10.0, 10, 10]))
CRUMB = RigidBody("crumb", "other", "crumb", 1e-6, np.array([0, 0, 0.5]), 1e-9 * np.eye(3))
AT_BOX = (ResponsePoint("seat", "box", np.array([0, 0, 0.5])),)
SPRING = Spring("spring", "springs", ("box", GROUND), np.zeros((2, 3)), stiffness=np.array([0, 0, 1e4]))
TO_GROUND = MountGroup(
    "Z", "box", MountRates(1e5, 1e5, 1e5), 0.1, (SOFT, STIFF),
    (Mount("box mount", "Z", ("box", GROUND), np.zeros((2, 3))),),
)  # fmt: skip
NO_RATES = MountRates(0.0, 0.0, 0.0)


def on_tyres(**changes) -> Vehicle:
    return replace(CABIN, connections=tuple(replace(t, **changes) for t in CABIN.tyres))


def with_groups(**changes) -> Vehicle:
    return replace(CABIN, mount_groups=tuple(replace(g, **changes) for g in CABIN.mount_groups))


VEHICLES = {
    "one body": Vehicle("v", (BOX,), ()),
    "one body on a road": Vehicle("v", (BOX,), (), response_points=AT_BOX, roads=CABIN.roads),
    "one spring": Vehicle("v", (BOX,), (SPRING,), response_points=AT_BOX),
    "all free": Vehicle("v", (BOX, BEAM), (), response_points=AT_BOX),
    "no mounts": replace(CABIN, mount_groups=(), rate_sets={}),
    "one mount": Vehicle("v", (BOX,), (), (TO_GROUND,), response_points=AT_BOX, roads=CABIN.roads),
    "no roles": replace(CABIN, bodies=tuple(replace(b, role="other") for b in CABIN.bodies)),
    "frame without nodes": Vehicle(
        "v", (replace(BEAM, nodes=np.zeros((0, 3)), shapes=np.zeros((0, 6, 14))),), ()
    ),
    "frame of one node": Vehicle(
        "v", (replace(BEAM, nodes=BEAM.nodes[:1], shapes=BEAM.shapes[:1]),), ()
    ),
    "no attachments": Vehicle("v", (replace(BEAM, attachments=()),), ()),
    "rigid modes only": Vehicle("v", (BEAM.truncated(6),), ()),
    "two frames": Vehicle("v", (BEAM, replace(BEAM, name="other", label="other")), ()),
    "one tyre": replace(CABIN, connections=CABIN.tyres[:1]),
    "no tyres": replace(CABIN, connections=(), wheel_loads=()),
    "tyres without rates": on_tyres(stiffness=np.zeros(3), damping=np.zeros(3)),
    "wheels in one place": on_tyres(wheel_center=np.zeros(3)),
    "undamped tyres": on_tyres(damping=np.zeros(3)),
    "mounts without rates": with_groups(rates=NO_RATES, bounds=(NO_RATES, SOFT), loss_factor=0.0),
    "even road": replace(CABIN, roads=tuple(replace(r, spectrum=0 * r.spectrum) for r in CABIN.roads)),
    "seat that nothing shakes": replace(
        CABIN, bodies=(*CABIN.bodies, BOX), response_points=AT_BOX,
        mount_groups=(*CABIN.mount_groups, TO_GROUND),
    ),
    "crumb": Vehicle("v", (BOX, CRUMB), (replace(SPRING, bodies=("box", "crumb")),)),
    "heavy load": replace(CABIN, added_masses=(AddedMass("m", "cab", np.array([0, 0, 1.0]), 1e6),)),
    "load of nothing": replace(CABIN, wheel_loads=(replace(CABIN.wheel_loads[0], amplitude=0.0),)),
}  # fmt: skip

COMMANDS = {
    "modes": [],
    "psd": [],
    "wheels": [],
    "report": ["--no-pictures", "--output", "report.html"],
    "optimise": ["--starts", "2", "--budget", "40"],
    "scatter": ["--samples", "8"],
}


@pytest.mark.parametrize("name", VEHICLES)
def test_every_command_has_an_answer_or_a_sentence(tmp_path, monkeypatch, capsys, name):
    monkeypatch.chdir(tmp_path)
    write_vehicle(VEHICLES[name], tmp_path / "v")
    with shared_preparations():
        for command, options in COMMANDS.items():
            status = main([command, "v", *options])
            captured = capsys.readouterr()
            assert status in (0, 2)
            assert bool(captured.out) == (status == 0)
            said = captured.err.splitlines()
            refusals = [line for line in said if not line.startswith("modeviz: note: ")]
            assert len(refusals) == (status == 2)
            assert "nan" not in captured.out.replace("resonance", "")
        assert main(["modes", "v"]) == 0


def test_a_road_that_no_tyre_passes_on_is_refused(tmp_path, capsys):
    for name in ("no tyres", "tyres without rates"):
        write_vehicle(VEHICLES[name], tmp_path / name)
        assert main(["psd", str(tmp_path / name)]) == 2
        assert "road 'flat' does not shake vehicle 'cabin'" in capsys.readouterr().err


def test_a_problem_on_a_road_that_shakes_nothing_is_refused():
    performance = Performance(np.array([6.0, 7.0]), roads=("flat",))
    asked = replace(default_problem(CABIN), performance=(performance,))
    with pytest.raises(VehicleError, match="road 'flat' shakes nothing; expected a"):
        replace(CABIN, connections=(), wheel_loads=(), problems=(asked,))


def test_a_rating_of_a_point_that_nothing_shakes_says_so(tmp_path, capsys):
    write_vehicle(VEHICLES["seat that nothing shakes"], tmp_path / "v")
    assert main(["psd", str(tmp_path / "v")]) == 0
    assert "nothing that shakes the vehicle gets to this point" in capsys.readouterr().out


def test_a_place_beyond_any_vehicle_is_refused_with_its_distance():
    with pytest.raises(VehicleError, match="mesh part 'skin': found a vertex 1e\\+300 m from"):
        MeshPart("skin", 1e300 * np.eye(3), np.array([[0, 1, 2]]), Material((0, 0, 0)))


def test_places_of_all_kinds_have_the_limit():
    for value, field, place in (
        (BOX, "center_of_gravity", [0, 0, 2e6]),
        (SPRING, "points", [[0, 0, 0], [0, -2e6, 0]]),
        (AT_BOX[0], "position", [1e99, 0, 0]),
        (BEAM.attachments[0], "position", [1e99, 0, 0]),
    ):
        with pytest.raises(VehicleError, match="expected places within 1e\\+06 m"):
            replace(value, **{field: place})
