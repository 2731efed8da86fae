"""What every page has besides what viser gives it: our style, dark or light, and scripts."""

import viser

from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.page.widgets.html import style_sheet

BRAND = {False: (32, 104, 168), True: (64, 146, 214)}
"""By darkness, of what can be pressed: the light page's blue is too dim in the dark."""


def dress(gui: viser.GuiApi, dark: bool, *own_scripts: str) -> None:
    """Makes all pages dark or light, in our style, without viser's own buttons.

    Args:
        gui: of the pages.
        dark: whether they are.
        *own_scripts: that these pages have besides those of all.
    """
    scripts.run(gui, "page/browser/style.js", style_sheet())
    for script in ("page/browser/delivery.js", "page/browser/zoom.js", *own_scripts):
        scripts.run(gui, script)
    gui.configure_theme(
        dark_mode=dark, show_logo=False, show_share_button=False, brand_color=BRAND[dark]
    )
