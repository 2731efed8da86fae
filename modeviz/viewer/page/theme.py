"""The looks that viser itself gives a page: dark or light, and one colour for what can be pressed."""

import viser

BRAND = {False: (32, 104, 168), True: (64, 146, 214)}
"""By darkness: the light page's blue is too dim in the dark."""


def choose_theme(gui: viser.GuiApi, dark: bool) -> None:
    """Makes all pages dark or light, without viser's own buttons."""
    gui.configure_theme(
        dark_mode=dark, show_logo=False, show_share_button=False, brand_color=BRAND[dark]
    )
