"""A page of a review changes nothing, whatever it says: tried at the websocket with all there is."""

import typing

import pytest
import viser
from guests import guest, hand_over, heard, heard_until, opened, take_back
from mounted_cabin import mounted_cabin
from visitors import PART_OF_FILE, encoded, update, wait_until

from benchmarks.page_client import wire
from modeviz.analysis.results import Conditions
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.page.widgets.named_buttons import FACELESS
from modeviz.viewer.page.wire import decoding
from modeviz.viewer.session.commands.decisions import Pin, PlaceMounts, SetRate
from modeviz.viewer.session.commands.looks import ChangeLook, SelectGroup

PATIENCE_S = 60
FOR_ALL = {"View", "Help"}
"""Labels of shared widgets with which a page changes only itself."""

COMMANDS_FOR_ALL = {"This guide"}


@pytest.fixture(scope="module")
def app():
    server, vehicle = open_server(port=0), mounted_cabin()
    app = App(vehicle, vehicle.rates, Conditions("flat", 20.0), server)
    app.start()
    app.session.do(SelectGroup("A"))
    app.session.do(ChangeLook(handle=True))
    assert app.session.wait_checked(PATIENCE_S)
    yield app
    app.close()


@pytest.fixture
def onlooker(app):
    with guest(app.server, "Anna") as page:
        heard(page)
        yield page


def shared_widgets(app):
    return dict(app.server.gui._gui_input_handle_from_uuid)


def another_value(widget):
    """One that the widget can have, and has not now."""
    props, value = widget._impl.props, widget._impl.value
    options = getattr(props, "options", None)
    if options:
        return next((option for option in options if option != value), value)
    if isinstance(value, bool):
        return not value
    if isinstance(value, (int, float)):
        low, high = getattr(props, "min", None), getattr(props, "max", None)
        wanted = value + 1 if low is None or high is None else low if value != low else high
        return type(value)(wanted)
    return f"{value}x"


def everything(app):
    """All that pages show of the session: its state, its widgets, and its handle in the scene."""
    handle = app.server.scene._handle_from_node_name["/mount handle"]
    values = {
        uuid: widget._impl.value
        for uuid, widget in shared_widgets(app).items()
        if not isinstance(widget, viser.GuiUploadButtonHandle)
    }
    return app.session.state, values, tuple(handle.position), tuple(handle.wxyz)


def has_value(message):
    """Whether a page is told the value of a widget."""
    return "value" in message.get("updates", {})


def test_no_widget_of_the_page_is_changed_by_who_looks(app, onlooker):
    before, widgets, events = everything(app), shared_widgets(app), []
    used = []
    for widget in widgets.values():
        widget._impl.update_cb.append(lambda event: used.append(event.target._impl.props.label))
    for uuid, widget in widgets.items():
        if isinstance(widget, viser.GuiUploadButtonHandle) or widget.label in FOR_ALL:
            continue
        value = True if isinstance(widget, viser.GuiButtonHandle) else another_value(widget)
        onlooker.send(wire("GuiUpdateMessage", uuid=uuid, updates={"value": value}))
        events.append(uuid)
    # Each is put back: told its true value, however it was before.
    heard_until(onlooker, lambda told: set(events) <= {m["uuid"] for m in told if has_value(m)})
    assert app.session.wait(PATIENCE_S)
    assert used == []
    assert everything(app) == before
    assert len(events) > 80
    assert {widget.label for widget in widgets.values() if vars(widget).get("is_for_all")} == FOR_ALL


def test_no_command_is_obeyed_that_changes_anything(app, onlooker):
    before, obeyed = everything(app), []
    commands = app.server.gui._command_handle_from_uuid
    for uuid, command in commands.items():
        command.on_trigger(lambda event: obeyed.append(event.target._impl.props.label))
        onlooker.send(wire("CommandTriggerMessage", uuid=uuid))
    wait_until(lambda: obeyed)
    heard(onlooker)
    assert set(obeyed) == COMMANDS_FOR_ALL
    assert everything(app) == before


def scene_messages(app):
    """What a page says of the scene, and of files."""
    point = {"position": (0.0, 0.0, 0.0), "wxyz": (1.0, 0.0, 0.0, 0.0)}
    upload = next(
        uuid
        for uuid, widget in shared_widgets(app).items()
        if isinstance(widget, viser.GuiUploadButtonHandle)
    )
    click = {
        "instance_index": None,
        "ray_origin": (0.0, 0.0, 0.0),
        "ray_direction": (1.0, 0.0, 0.0),
        "screen_pos": (0.5, 0.5),
        "modifier": None,
    }
    yield from (wire("SceneNodeClickMessage", name=name, **click) for name in clickable(app))
    yield wire("TransformControlsDragStartMessage", name="/mount handle")
    yield wire("TransformControlsUpdateMessage", name="/mount handle", **point)
    yield wire("TransformControlsDragEndMessage", name="/mount handle")
    file = {"source_component_uuid": upload, "transfer_uuid": "t"}
    yield wire(
        "FileTransferStartUpload",
        **file, filename="v.csv", mime_type="text/csv", part_count=1, size_bytes=3,
    )  # fmt: skip
    yield encoded({**PART_OF_FILE, **file, "content": b"a,b"})


def clickable(app):
    nodes = app.server.scene._handle_from_node_name.items()
    return [name for name, node in nodes if getattr(node._impl, "click_cb", None)]


def test_no_click_no_drag_and_no_file_of_who_looks_changes_anything(app, onlooker):
    app.session.do(SelectGroup("B"))
    assert app.session.wait_checked(PATIENCE_S)
    before = everything(app)
    assert clickable(app)
    for message in scene_messages(app):
        onlooker.send(message)
    put_back = {"SetPositionMessage", "SetOrientationMessage", "FileTransferPartAck"}
    told = heard_until(onlooker, lambda told: put_back <= {m["type"] for m in told} and told)
    assert app.session.wait(PATIENCE_S)
    assert everything(app) == before
    assert app.server.gui._current_file_upload_states == {}
    placed = next(m for m in told if m["type"] == "SetPositionMessage" and m["name"] == "/mount handle")
    handle = app.server.scene._handle_from_node_name["/mount handle"]
    assert placed["position"] == pytest.approx(tuple(handle.position))


def test_every_kind_of_message_is_either_tried_here_or_a_pages_own():
    """Of the kinds that are let through to viser: a new one has to be thought of here."""
    kinds = {kind.__name__ for kind in typing.get_args(decoding._decoder.type)}
    own = {"ViewerCameraMessage", "GetRenderResponseMessage", "FileTransferPartAck"}
    tried = {
        "GuiUpdateMessage",
        "CommandTriggerMessage",
        "SceneNodeClickMessage",
        "TransformControlsDragStartMessage",
        "TransformControlsUpdateMessage",
        "TransformControlsDragEndMessage",
        "FileTransferStartUpload",
        "FileTransferPart",
    }
    assert kinds == own | tried


def test_what_the_owner_may_change_he_may_not_while_somebody_else_presents(app):
    slider = next(w for w in shared_widgets(app).values() if w.label == "Amplitude")
    with opened(app.server) as owner, guest(app.server, "Anna") as anna:
        hand_over(app.server, "Anna")
        owner.send(update(slider, 2.0))
        heard(owner)
        assert slider.value == 1.0
        anna.send(update(slider, 2.0))
        wait_until(lambda: slider.value == 2.0)
        take_back(app.server)
        owner.send(update(slider, 1.0))
        wait_until(lambda: slider.value == 1.0)


def test_a_handle_in_the_hand_of_who_loses_control_is_let_go(app):
    app.session.do(SelectGroup("A"))
    assert app.session.wait_checked(PATIENCE_S)
    handle = app.server.scene._handle_from_node_name["/mount handle"]
    begin = handle.position.tolist()
    there = {"position": (begin[0] + 0.1, *begin[1:]), "wxyz": (1.0, 0.0, 0.0, 0.0)}
    with guest(app.server, "Anna") as anna:
        hand_over(app.server, "Anna")
        anna.send(wire("TransformControlsDragStartMessage", name="/mount handle"))
        anna.send(wire("TransformControlsUpdateMessage", name="/mount handle", **there))
        wait_until(lambda: app.session.state.design.alterations.placement("A").offset[0])
        assert app.session._asked._history.undone_next.author.name == "Anna"
        take_back(app.server)
        anna.send(wire("TransformControlsDragEndMessage", name="/mount handle"))
        app.session.do(PlaceMounts("A", "offset", (0.0, 0.0, 0.0)))
        wait_until(lambda: handle.position == pytest.approx(begin))


def asked(messages):
    """The buttons of the question that a page was asked, by their words."""
    buttons = {m["props"]["label"]: m["uuid"] for m in messages if m["type"] == "GuiButtonMessage"}
    return {words: uuid for words, uuid in buttons.items() if words != FACELESS}


def buttons_of_question(page, last):
    """The buttons of the question that a page is asked next, of which the last one is known."""
    return heard_until(page, lambda told: asked(told) if last in asked(told) else None)


def press(page, uuid):
    page.send(wire("GuiUpdateMessage", uuid=uuid, updates={"value": True}))


def press_of(app, page, label, option):
    """Presses one of a group of buttons."""
    group = next(w for w in shared_widgets(app).values() if w.label == label)
    page.send(update(group, option))


def rate(app):
    return app.session.state.design.rates["A"].lateral


def test_who_presents_takes_back_his_own_changes_and_is_told_whose_others_are(app):
    first, lateral = rate(app), next(w for w in shared_widgets(app).values() if w.label == "Lateral")
    with opened(app.server, name="Olga") as owner, guest(app.server, "Anna") as anna:
        owner.send(update(lateral, another_value(lateral)))
        wait_until(lambda: rate(app) != first)
        owners = rate(app)
        hand_over(app.server, "Anna")
        assert app.session.wait(PATIENCE_S)
        anna.send(update(lateral, lateral._impl.props.max))
        wait_until(lambda: rate(app) != owners)
        heard(anna)
        press_of(app, anna, "History", "Undo")
        wait_until(lambda: rate(app) == owners)
        press_of(app, anna, "History", "Undo")
        heard_until(
            anna,
            lambda told: any(
                m["type"] == "NotificationShowMessage" and "Olga" in m["props"]["body"] for m in told
            ),
        )
        assert rate(app) == owners

        take_back(app.server)
        press_of(app, owner, "History", "Redo")  # Anna's, so the owner is asked
        go_on = buttons_of_question(owner, "Go over it")["Go over it"]
        assert rate(app) == owners
        press(owner, go_on)
        wait_until(lambda: rate(app) != owners)
        press_of(app, owner, "History", "Undo")
        press(owner, buttons_of_question(owner, "Go over it")["Go over it"])
        wait_until(lambda: rate(app) == owners)
        press_of(app, owner, "History", "Undo")
        wait_until(lambda: rate(app) == first)


def test_a_pinned_set_is_replaced_only_by_who_says_so(app):
    def variants():
        return app.session.state.design.variants

    with opened(app.server) as owner, opened(app.server) as other:
        app.session.do(Pin("v1"))
        before = variants()["v1"]
        app.session.do(SetRate("A", "vertical", 1.23e5))
        owner.send(update(app.screen.controls.variants._name._box, "v1"))
        heard(owner), heard(other)
        press_of(app, owner, "Keep", "Pin")
        buttons = buttons_of_question(owner, "Pin as v1 2")
        assert set(buttons) == {"Leave it as it is", "Replace v1", "Pin as v1 2"}
        assert asked(heard(other)) == {}
        assert variants()["v1"] == before
        press(owner, buttons["Pin as v1 2"])
        wait_until(lambda: "v1 2" in variants())
        assert variants()["v1"] == before

        app.session.do(SetRate("A", "vertical", 2.34e5))
        press_of(app, owner, "Keep", "Pin")
        press(owner, buttons_of_question(owner, "Pin as v1 3")["Replace v1"])
        wait_until(lambda: variants()["v1"] != before)
        assert variants()["v1"].rates["A"].vertical == 2.34e5


def test_a_question_is_not_answered_by_who_has_lost_control_meanwhile(app):
    app.session.do(Pin("kept"))
    app.session.do(SetRate("A", "vertical", 3.21e5))
    before = app.session.state.design.variants["kept"]
    with guest(app.server, "Anna") as anna:
        hand_over(app.server, "Anna")
        anna.send(update(app.screen.controls.variants._name._box, "kept"))
        heard(anna)
        press_of(app, anna, "Keep", "Pin")
        buttons = buttons_of_question(anna, "Pin as kept 2")
        take_back(app.server)
        press(anna, buttons["Replace kept"])
        heard(anna)
        assert app.session.state.design.variants["kept"] == before


def test_what_a_page_has_for_itself_gives_a_visitor_no_control(app, onlooker):
    visitors, page = app.server.visitors, max(app.server.get_clients())
    before, card = everything(app), app.screen.review._cards[page]
    for button in (card._share, card._hand_over, card._take_back):
        press(onlooker, button._impl.uuid)
    for option in card._links.options:
        onlooker.send(update(card._links, option))
    onlooker.send(update(card._title, "Eve's own"))
    onlooker.send(update(card._name, "Eve"))
    heard(onlooker, 1.0)
    assert app.keeping.title.text == ""
    assert visitors.of_page(page).name == "Eve"
    assert visitors.is_shared
    assert not visitors.has_control(page)
    assert everything(app) == before
