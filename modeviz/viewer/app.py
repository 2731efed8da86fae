"""The page of a tuning session as a whole: what its parts are, and what goes from one to another."""

from collections.abc import Callable
from contextlib import ExitStack

from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError
from modeviz.journal.sessions import SessionId
from modeviz.journal.study_file import StudyFile
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.documents import Documents
from modeviz.viewer.keeping import Keeping
from modeviz.viewer.page.failures import Failures
from modeviz.viewer.page.server import Server
from modeviz.viewer.page.widgets.alerts import refuse
from modeviz.viewer.page.widgets.theme import dress
from modeviz.viewer.scene.mount_handle import Dragged
from modeviz.viewer.scene.scene import Scene
from modeviz.viewer.screen.page_parts import PageParts
from modeviz.viewer.screen.screen import Screen
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.decisions import DragMounts
from modeviz.viewer.session.commands.looks import SelectGroup
from modeviz.viewer.session.notifications import Answered, Checked, Failed, Notification, Preparing
from modeviz.viewer.session.opening import Opening
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.shared import Shared
from modeviz.viewer.session.state import first_state
from modeviz.viewer.session.view import Animation, CameraPose
from modeviz.viewer.tasks.front_task import FrontTask
from modeviz.viewer.tasks.scatter_task import ScatterTask
from modeviz.viewer.tasks.search_task import SearchTask
from modeviz.viewer.tasks.tasks import Tasks


class App:
    """The page of one tuning session, on a server of its own; all who open it see the same."""

    def __init__(
        self,
        vehicle: Vehicle,
        rates: Rates,
        conditions: Conditions,
        server: Server,
        dark: bool = False,
        opening: Opening | None = None,
        shared: Shared | None = None,
    ) -> None:
        """Builds the page; nothing is solved before `start`.

        Args:
            vehicle: with the rates that all is compared with.
            rates: to start with.
            conditions: to start with.
            server: an open one, see `page.server.open_server`.
            dark: whether the page is dark.
            opening: what to show first in place of rates and conditions, and what there was before.
            shared: what other sessions of the vehicle have in common with it, if there are any.

        Raises:
            ModevizError: the vehicle cannot have what it opens with.
        """
        opening = opening or Opening(first_state(vehicle, rates, conditions))
        self.server: Server = server
        self._failures = Failures(server)
        self.session: Session = Session(
            vehicle,
            opening.state,
            self._hear,
            past=opening.past,
            future=opening.future,
            shared=shared,
            acting=server.visitors.acting,
        )
        self.tasks: Tasks = self._new_tasks()
        self.keeping: Keeping = Keeping(server, self.session, self.tasks, self._animation, opening)
        dress(server.gui, dark, "page/browser/numbers.js", "page/browser/no_drop.js")
        self.scene: Scene = Scene(
            server, self.session.vehicle, dark, self._select, opening.camera, self._leave
        )
        """In the middle of every page."""
        self.scene.let_drag(self._drag, server.mistake, server.visitors.has_control)
        self.documents: Documents = Documents(
            server,
            self.session,
            self.scene,
            dark,
            self._animation,
            lambda: self.screen.controls.notes.notes,
        )
        self.screen: Screen = Screen(
            PageParts(
                server,
                self.session,
                self.scene,
                self.tasks,
                self.documents,
                self.keeping,
                opening,
                dark,
            )
        )
        self.screen.controls.earlier.show_newest()

    def start(self, progress: Callable[[float], None] | None = None) -> None:
        """Prepares the vehicle, which the page shows, and asks for the first answer.

        Args:
            progress: told the fraction of the preparation that is done as well.

        Raises:
            ModevizError: there is no answer on that road at that speed.
        """

        def tell(fraction: float) -> None:
            self.screen.controls.status.show_progress(fraction)
            if progress:
                progress(fraction)

        self.session.start(tell)

    def record(self, study: StudyFile, name: SessionId) -> None:
        """Keeps all that is done from now on in a study file, until the end; see `Recorder`.

        Args:
            study: where; what keeps it from being saved is said on every page.
            name: under which the study file knows the session.
        """
        controls = self.screen.controls
        self.keeping.begin(study, name, self.screen.show_trouble, controls.earlier.add)
        controls.notes.keep_in(study, name, self.keeping.author)

    def tell_failure(self, failed: Failed) -> None:
        """Says what went wrong; the last good answer stays on the screen."""
        self._failures.tell(failed)

    def end(self) -> None:
        """Ends the session and what may be running in it; where some of that fails, the rest, too."""
        with ExitStack() as ending:
            ending.callback(self.keeping.close)  # last: until pages are told, they go on
            ending.callback(self.session.close)
            ending.callback(self.screen.close)
            ending.callback(self.scene.close)
            ending.callback(self.tasks.close)

    def close(self) -> None:
        """Ends the session and the server, also where the first goes wrong."""
        try:
            self.end()
        finally:
            self.server.stop()

    def _animation(self) -> Animation:
        """Return how what moves is drawn now."""
        return self.screen.motion.animation.animation

    def _new_tasks(self) -> Tasks:
        session, mistake = self.session, self.server.mistake
        return Tasks(
            SearchTask(session, lambda: self.screen.controls.optimise.follow(), mistake),
            FrontTask(session, lambda: self.screen.controls.trade_off.follow(), mistake),
            ScatterTask(session, lambda: self.screen.controls.scatter.follow(), mistake),
        )

    def _hear(self, notification: Notification) -> None:
        """Puts what the session tells on every page."""
        match notification:
            case Answered(solved):
                self._show(solved)
                self._failures.withdraw()
            case Preparing(fraction):
                self.screen.show_progress(fraction)
            case Checked(solved):
                self.screen.show_check(solved)
            case Failed():
                self.tell_failure(notification)

    def _show(self, solved: Solved) -> None:
        """Draws an answer: the panels in one batch, the scene in another, which waits for a frame."""
        self.screen.show(solved)
        self.scene.hold(self.session.with_parts_of(solved.state), solved.now.prepared.vehicle)
        self.scene.show(solved)
        self.scene.place(self.session.state)
        self.screen.results.static.tell_scale(solved, self.scene.exaggeration)

    def _leave(self, client_id: int, camera: CameraPose | None) -> None:
        """Notes where who is in control left a camera."""
        if self.server.visitors.has_control(client_id):
            self.keeping.leave(camera)

    def _select(self, group: str) -> None:
        self.screen.controls.opener.ask()
        self.session.do(SelectGroup(group))

    def _drag(self, dragged: Dragged) -> None:
        """Puts the mounts of a group where their handle is, unless that is off a body: then nowhere."""
        try:
            self.session.do(DragMounts(dragged.group, dragged.placement, dragged.drag))
        except ModevizError as refusal:
            if dragged.is_over and dragged.client is not None:
                refuse(dragged.client, str(refusal), is_passing=True)
        self.scene.place(self.session.state)
