"""Labels that stay apart from each other, whatever the camera sees; the page finds their places.

Leans on private parts of viser 1.1.1 as driver.py does; tests/browser/test_scene.py fails when they
change.
"""

from collections.abc import Sequence

import viser

from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.scene.stage import Theme

LABEL_LETTERS = 24
"""In a label: with more it would find no place."""


def keep_apart(scene: viser.SceneApi, names: Sequence[str], card: str, line: str, theme: Theme) -> None:
    """Starts the script that places labels beside their parent nodes.

    Args:
        scene: that they are in, each anchored at its middle.
        names: of their nodes, the more important ones first.
        card: node of the label that has the first choice and hangs further away.
        line: node of the line to it, one metre along x.
        theme: whose colours they have.
    """
    colors = {
        "ink": [float(c / 255) for c in theme.ink],
        "paper": [float(c / 255) for c in theme.paper],
    }
    scripts.run(scene, "scene/labels.js", list(names), card, line, colors)
