"""What is shown, to be taken away: a page that needs no server, a link, a report, and their names."""

from collections.abc import Callable, Sequence
from datetime import date
from functools import cache

from modeviz.errors import ModevizError
from modeviz.journal.fingerprint import fingerprint_of
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html import Picture, report
from modeviz.report.notes import Note
from modeviz.vehicle.arrays import Floats
from modeviz.viewer.offline import offline_page
from modeviz.viewer.page.server import Server
from modeviz.viewer.scene.scene import Scene
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.coloring import ColorScale
from modeviz.viewer.session.cursor import has_ride
from modeviz.viewer.session.design import variant_name
from modeviz.viewer.session.encoding.link import link_of
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.view import Animation, CameraPose


class Documents:
    """Makes of a session, as it is shown, what can be taken away."""

    def __init__(
        self,
        server: Server,
        session: Session,
        scene: Scene,
        dark: bool,
        animation: Callable[[], Animation],
        notes: Callable[[], Sequence[Note]],
    ) -> None:
        """Makes nothing yet.

        Args:
            server: whose scene it is.
            session: what is shown.
            scene: where it is drawn.
            dark: whether pages are dark.
            animation: how what moves is drawn now.
            notes: what is noted by now.
        """
        self._server, self._session, self._scene, self._dark = server, session, scene, dark
        self._animation, self._notes = animation, notes
        self._fingerprint = cache(lambda: fingerprint_of(session.original).digest)

    def solved(self) -> Solved:
        """Return the answer that is shown.

        Raises:
            ModevizError: nothing is shown yet.
        """
        if self._session.answer is None:
            raise ModevizError("nothing is solved yet: try again when the preparation is done")
        return self._session.answer

    def color_scale(self) -> ColorScale | None:
        """Return the scale of the colours, if they mean something; raises as `solved` and the scene."""
        return self._scene.color_scale(self.solved())

    def subject(self) -> str:
        """Return what is to be seen, as names of files have it: "Pickup cab yaw"."""
        last = self._session.answer
        return f"{self._session.vehicle.name} {last.movement.subject if last else ''}"

    def caption(self) -> str:
        """Return what is to be seen, as stands under a picture: "Cab yaw 9.71 Hz, Original"."""
        solved = self.solved()
        return f"{solved.movement.heading}, {self._variant(solved)}"

    def offline(self, position: Floats, look_at: Floats) -> bytes:
        """Return what is shown as a file that needs no server, see `offline_page`.

        Args:
            position: of the camera it opens with, m.
            look_at: what that looks at, m.

        Raises:
            ModevizError: nothing is shown yet.
        """
        solved = self.solved()
        with self._scene.without_handle():
            return offline_page(
                self._server, solved, self._variant(solved), self._dark, position, look_at
            )

    def link(self, camera: CameraPose) -> str:
        """Return what is shown as a text that `opening_of_link` reads.

        Args:
            camera: from where it is seen.

        Raises:
            ModevizError: it does not fit into an address.
        """
        session, animation = self._session, self._animation()
        return link_of(session.state, animation, camera, session.vehicle, self._fingerprint())

    def report(self, pictures: Sequence[Picture]) -> bytes:
        """Return the present rates against the set they are compared with, see `report.html`.

        Raises:
            ModevizError: nothing is shown yet.
        """
        solved = self.solved()
        state, name = solved.state, self._variant(solved)
        now = RateSet(name if name != state.against else f"{name}, now", state.design.rates)
        base = RateSet(state.against, solved.base.rates)
        comparison = compare(
            solved.now.prepared,
            base,
            now,
            state.conditions if has_ride(self._session.vehicle) else None,
            solved.base.prepared,
            self._session.original,
        )
        check = solved.findings.check
        return report(comparison, date.today(), pictures, check, self._notes()).encode()

    def illustrated_report(self, png: bytes) -> bytes:
        """Return the report with a picture of the scene as it is."""
        return self.report([Picture(self.caption(), png)])

    def _variant(self, solved: Solved) -> str:
        return variant_name(self._session.vehicle, solved.state.design)
