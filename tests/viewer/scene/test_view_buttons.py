from types import SimpleNamespace

from modeviz.viewer.scene.cameras import add_view_buttons
from modeviz.viewer.scene.stage import VIEWS


class Buttons:
    """Stands for viser's group of buttons."""

    def __init__(self, names):
        self.names, self.value, self.clicked = names, names[0], []

    def on_click(self, function):
        self.clicked.append(function)


def test_there_is_a_button_for_every_view_that_turns_the_camera_of_who_clicks():
    made, looked = [], []

    def add_button_group(label, names, hint):
        made.append(Buttons(names))
        return made[-1]

    gui = SimpleNamespace(add_button_group=add_button_group, add_html=lambda _: None)
    add_view_buttons(gui, lambda client, view: looked.append((client, view)))
    (buttons,) = made
    assert buttons.names == tuple(VIEWS)
    (click,) = buttons.clicked
    buttons.value = "Top"
    click(SimpleNamespace(client=None))
    click(SimpleNamespace(client="page"))
    assert looked == [("page", "Top")]
