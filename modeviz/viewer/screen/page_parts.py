"""What the panels of a tuning page are built on."""

from dataclasses import dataclass

from modeviz.viewer.documents import Documents
from modeviz.viewer.keeping import Keeping
from modeviz.viewer.page.server import Server
from modeviz.viewer.scene.scene import Scene
from modeviz.viewer.session.opening import Opening
from modeviz.viewer.session.session import Session
from modeviz.viewer.tasks.tasks import Tasks


@dataclass(frozen=True, eq=False)
class PageParts:
    """All of a page but its panels."""

    server: Server
    session: Session
    """What panels show and change."""
    scene: Scene
    tasks: Tasks
    """What is computed beside the session."""
    documents: Documents
    """What can be taken away."""
    keeping: Keeping
    """What of all this is kept."""
    opening: Opening
    """With which the session was opened."""
    dark: bool
    """Whether pages are."""
