"""Left column, lower part: how the truck is looked at, and pictures of it."""

from collections.abc import Callable
from io import BytesIO

import imageio.v3 as iio
import viser

from modeviz.viewer.session import Session

VIEWS = ("Iso", "Side", "Front", "Top", "Under")
COLORINGS = {"Bodies": "bodies", "Displacement": "displacement"}
SIZES = {"1920 × 1080": (1920, 1080), "1280 × 720": (1280, 720), "3840 × 2160": (3840, 2160)}
TIMEOUT = 60.0
"""s: a picture takes long where a page renders in software."""


class ViewPanel:
    """Camera presets, colours, see-through, ghost, and the error of the classic method."""

    def __init__(
        self, gui: viser.GuiApi, session: Session, look: Callable[[viser.ClientHandle, str], None]
    ) -> None:
        """Builds the controls.

        Args:
            gui: where.
            session: what the choices change.
            look: turns a page's camera to one of `VIEWS`.
        """
        views = gui.add_button_group("View", VIEWS, hint="Where to look from")

        @views.on_click
        def _(event: viser.GuiEvent) -> None:
            if event.client is not None:
                look(event.client, views.value)

        coloring = gui.add_dropdown(
            "Colour", tuple(COLORINGS), hint="What the colours of the bodies mean"
        )
        coloring.on_update(lambda _: session.change(coloring=COLORINGS[coloring.value]))
        through = gui.add_checkbox(
            "See through", session.state.see_through, hint="Shows mounts and engine"
        )
        through.on_update(lambda _: session.change(see_through=through.value))
        ghost = gui.add_checkbox(
            "Undeformed", session.state.ghost == "rest", hint="Outlines of the truck at rest"
        )
        ghost.on_update(lambda _: session.change(ghost="rest" if ghost.value else "none"))
        classic = gui.add_checkbox(
            "Classic error",
            session.state.classic,
            hint="How far the paper's equation, on the original modes alone, is off; see below",
        )
        classic.on_update(lambda _: session.change(classic=classic.value))


class PicturePanel:
    """A picture of the 3-D view as a PNG file."""

    def __init__(self, gui: viser.GuiApi, file_name: Callable[[], str]) -> None:
        """Builds the controls; `file_name` names a picture, without its ending."""
        size = gui.add_dropdown("Size", tuple(SIZES), hint="Width and height of the picture, pixels")
        button = gui.add_button("Save picture", icon=viser.Icon.CAMERA, hint="PNG of the 3-D view")

        @button.on_click
        def _(event: viser.GuiEvent) -> None:
            client = event.client
            if client is None:
                return
            button.disabled = True
            try:
                content = png(client, *SIZES[size.value])
                client.send_file_download(f"{file_name()}.png", content, save_immediately=True)
            except TimeoutError:
                client.add_notification(
                    "No picture",
                    f"The page did not draw it within {TIMEOUT:.0f} s: try a smaller size.",
                )
            finally:
                button.disabled = False


def png(client: viser.ClientHandle, width: int, height: int) -> bytes:
    """The 3-D view of a page as a PNG file with a transparent background.

    Raises:
        TimeoutError: the page did not draw it in time.
    """
    image = client.get_render(height, width, transport_format="png", timeout=TIMEOUT)
    content = BytesIO()
    iio.imwrite(content, image, extension=".png")
    return content.getvalue()
