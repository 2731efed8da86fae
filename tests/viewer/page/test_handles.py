import pytest

from modeviz.viewer.page.server import open_server
from modeviz.viewer.page.widgets.handles import assign, send


@pytest.fixture(scope="module")
def server():
    server = open_server(port=0)
    yield server
    server.stop()


@pytest.fixture
def sent(server):
    """Returns what has been sent since the test began or since it was last asked."""
    buffer = server._websock_server._broadcast_buffer
    first = buffer.message_counter

    def sent():
        nonlocal first
        new = [message for i, message in buffer.message_from_id.items() if i >= first]
        first = buffer.message_counter
        return new

    return sent


def test_only_what_is_new_is_sent(server, sent):
    label = server.gui.add_slider("Stiffness", 0.0, 1.0, 0.1, 0.5)
    sent()
    assign(label, label="Stiffness", hint="N/mm", visible=True)
    assert [message.updates for message in sent()] == [{"hint": "N/mm"}]
    assign(label, label="Stiffness", hint="N/mm", visible=True)
    assert sent() == []
    assert label.hint == "N/mm"


def test_what_viser_keeps_in_another_way_is_assigned_its_way(server, sent):
    frame = server.scene.add_frame("/frame")
    sent()
    assign(frame, visible=False)
    (message,) = sent()
    assert (message.name, message.visible) == ("/frame", False)
    assert not frame.visible


def test_a_page_that_opens_later_gets_the_value_sent(server, sent):
    text = server.gui.add_html("old")
    sent()
    assign(text, content="new")
    send(text, "content", "newest")
    assert [message.updates for message in sent()] == [{"content": "newest"}]
