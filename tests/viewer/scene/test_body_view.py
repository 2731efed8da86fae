from dataclasses import replace

import numpy as np
from builtin_truck import builtin_truck
from mounted_cabin import mounted_cabin

from modeviz.analysis.preparation import prepare
from modeviz.vehicle.arrays import FARTHEST
from modeviz.vehicle.bodies import FlexibleBody, Material, MeshPart
from modeviz.vehicle.loads import ResponsePoint
from modeviz.viewer.page.server import open_server
from modeviz.viewer.scene.body_view import DrawnBody
from modeviz.viewer.scene.scene import Scene
from modeviz.viewer.scene.stage import LIGHT


class Driver:
    """Stands for the page's: keeps what is visible."""

    def __init__(self):
        self.visible = {}

    def add(self, path, *_, **__):
        self.visible[path] = True

    def set_visible(self, path, visible):
        self.visible[path] = visible

    def set_opacity(self, path, opacity):
        pass


def test_every_flexible_body_has_outlines_that_are_put_away():
    driver = Driver()
    bodies = builtin_truck().bodies
    drawn = [DrawnBody.of(driver, body, LIGHT) for body in bodies if body.mesh]
    outlines = {path for path in driver.visible if path.startswith("/ghost/")}
    assert outlines == {f"/ghost/{body.name}" for body in bodies if isinstance(body, FlexibleBody)}
    for body in drawn:
        body.show(visible=True, see_through=True, ghost=False)
    assert {path for path, visible in driver.visible.items() if not visible} == outlines


def test_no_motion_is_too_large_to_be_sent():
    """A speck that turns in a vehicle of a thousand kilometres turns by more than halves can say."""
    vehicle = mounted_cabin()
    cab, *others = vehicle.bodies
    speck = cab.center_of_gravity + 1e-3 * np.eye(3)
    drawn = replace(cab, mesh=(MeshPart("speck", speck, [[0, 1, 2]], Material((9, 9, 9))),))
    seat = ResponsePoint("seat", cab.name, np.array([FARTHEST, 0.0, 0.0]))
    vast = replace(vehicle, bodies=(drawn, *others), response_points=(seat,))
    prepared = prepare(vast)
    server = open_server(port=0)
    try:
        scene = Scene(server, vast, False, lambda _: None)
        turning = np.zeros(prepared.system.n_dofs)
        turning[prepared.system.dofs[cab.name]] = [0, 0, 0, 0, 0, 1]
        moved = scene.show_shape(prepared.system, turning, None)[cab.name]
        np.testing.assert_allclose(moved[:, 0], -65504 * (speck - cab.center_of_gravity)[:, 1])
    finally:
        server.stop()
