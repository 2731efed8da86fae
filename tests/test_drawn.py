from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.files import builtin_vehicle, read_vehicle
from modeviz.viewer.drawn import DrawnBody
from modeviz.viewer.stage import LIGHT


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
    bodies = read_vehicle(builtin_vehicle()).bodies
    drawn = [DrawnBody(driver, body, LIGHT) for body in bodies if body.mesh]
    outlines = {path for path in driver.visible if path.startswith("/ghost/")}
    assert outlines == {f"/ghost/{body.name}" for body in bodies if isinstance(body, FlexibleBody)}
    for body in drawn:
        body.show(visible=True, see_through=True, ghost=False)
    assert {path for path, visible in driver.visible.items() if not visible} == outlines
