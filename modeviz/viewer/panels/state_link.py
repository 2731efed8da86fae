"""A button that gives a page the link to what it shows."""

from collections.abc import Callable

import viser

from modeviz.errors import ModevizError
from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.page.widgets.html import block
from modeviz.viewer.scene.cameras import pose_of
from modeviz.viewer.session.view import CameraPose

COPY = "Copy link"
BOX = "mv-view-link"
ABOUT = (
    "Whoever may open this page sees the same vehicle, rates, mode, camera and plots under it, in a "
    "session of their own, and on another day. It lets nobody in who could not come in without it."
)


def add_link_button(gui: viser.GuiApi, link: Callable[[CameraPose], str]) -> None:
    """Builds the button.

    Args:
        gui: where.
        link: gives the link to what is shown, seen from there; raises ModevizError if there is none.
    """
    buttons = gui.add_button_group(
        "Link", (COPY,), hint="An address that opens this view again, here or with somebody else"
    )

    @buttons.on_click
    def _(event: viser.GuiEvent) -> None:
        if event.client is not None:
            _give(event.client, link)


def _give(client: viser.ClientHandle, link: Callable[[CameraPose], str]) -> None:
    """Opens a window with the link on a page, which copies it if its browser lets it."""
    try:
        view = link(camera_of(client))
    except ModevizError as error:
        client.add_notification("No link", str(error), color="red")
        return
    window = client.gui.add_modal("Link to this view")
    with window:
        field = '<input class="link" readonly aria-label="Link to this view">'
        client.gui.add_html(
            block(f'<div id="{BOX}">{field}<span class="dim"></span></div><p>{ABOUT}</p>')
        )
        close = client.gui.add_button("Close")
    close.on_click(lambda _: window.close())
    scripts.run(client.gui, "panels/copy_link.js", BOX, view)


def camera_of(client: viser.ClientHandle) -> CameraPose:
    """Return where a page's camera is; raises ModevizError where none can be."""
    pose = pose_of(client.camera.position, client.camera.look_at)
    if pose is None:
        raise ModevizError("the camera is nowhere: choose a view first")
    return pose
