"""What an event of a slider does not do, because it takes long."""

from mounted_cabin import mounted_cabin

from modeviz.analysis.results import Conditions
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.commands.looks import ChangeLook, LookAtRigid


def test_an_answer_is_drawn_without_building_its_vehicle_again():
    """All of a vehicle is checked when it is made, which takes as long as solving it."""
    vehicle = mounted_cabin()
    server = open_server(port=0, token="open-sesame-open")
    app = App(vehicle, vehicle.rates, Conditions("flat", 20.0), server)
    app.start()
    try:
        app.session.do(ChangeLook(coloring="strain energy"))
        app.session.do(LookAtRigid(drawn=True))
        app.session.do(SetRate("A", "vertical", 7e5))
        assert app.session.wait(60)
        now = app.session.answer.now
        assert now.rates["A"].vertical == 7e5
        assert "vehicle" not in vars(now)
        assert "system" not in vars(now)
    finally:
        app.close()
