"""What a page is sent for an absorber: its own controls and marks, however much else there is."""

from collections import Counter
from contextlib import contextmanager
from dataclasses import replace

from mounted_cabin import mounted_cabin

from modeviz.vehicle.absorber import Absorber
from modeviz.viewer.session.commands.absorbers import AddAbsorber, RemoveAbsorber, WeighAbsorber

SOON = 60
ROOF = Absorber("roof", "cab", (1.0, 0.2, 1.4), 6.0, 12.0, 0.1)
UPDATES = {
    "GuiUpdateMessage",
    "SceneNodeUpdateMessage",
    "SetSceneNodeVisibilityMessage",
    "SetPositionMessage",
    "SetOrientationMessage",
    "SetGuiPanelLabelMessage",
    "RunJavascriptMessage",
}
"""Messages that change what there is."""


@contextmanager
def counted(app):
    """The kinds of messages that are sent to all pages inside the block, but of changes."""
    socket, sent = app.server._websock_server, Counter()
    queue = socket.queue_message

    def count(message):
        if type(message).__name__ not in UPDATES:
            sent[type(message).__name__] += 1
        queue(message)

    socket.queue_message = count
    try:
        yield sent
        assert app.session.wait(SOON)
    finally:
        del socket.queue_message


def with_groups(count):
    """The cabin with its front mounts in that many groups."""
    cabin = mounted_cabin()
    front, rear = cabin.mount_groups
    groups = [
        replace(
            front,
            name=f"A{i}",
            mounts=tuple(replace(mount, name=f"{i} {mount.name}") for mount in front.mounts),
        )
        for i in range(count)
    ]
    return replace(cabin, mount_groups=(*groups, rear), rate_sets={})


def test_an_absorber_is_added_and_removed_without_building_what_others_have_anew(opened):
    built = []
    for count in (1, 6):
        app = opened(with_groups(count))
        with counted(app) as added:
            app.session.do(AddAbsorber(ROOF))
        assert not {kind for kind in added if "Remove" in kind}
        assert added["GlbMessage"] == 1  # no ghost, no other body
        built.append(added)
        with counted(app) as weighed:
            app.session.do(WeighAbsorber("roof", 7.0))
        assert weighed["GlbMessage"] == 1
        assert {*weighed} <= {"GlbMessage", "FrameMessage", "RemoveSceneNodeMessage"}
        with counted(app) as removed:
            app.session.do(RemoveAbsorber("roof"))
        n_controls = sum(n for kind, n in added.items() if kind.startswith("Gui"))
        assert 0 < removed["GuiRemoveMessage"] <= n_controls
        assert not {kind for kind in removed if kind.startswith("Gui")} - {"GuiRemoveMessage"}
    assert built[0] == built[1]
