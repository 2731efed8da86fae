"""What a session leaves in its study: what is decided and computed, pictures, how it is seen."""

from collections.abc import Callable
from functools import partial

from modeviz.journal.runs import Run
from modeviz.journal.sessions import SessionId
from modeviz.journal.study_file import StudyFile
from modeviz.viewer.page.server import Server
from modeviz.viewer.session.opening import Opening
from modeviz.viewer.session.recorder import Recorder
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.session_title import SessionTitle
from modeviz.viewer.session.view import Animation, CameraPose, PageView
from modeviz.viewer.tasks.run_recorder import RunRecorder
from modeviz.viewer.tasks.tasks import Tasks


class Keeping:
    """Keeps a session in a study file, from when there is one."""

    def __init__(
        self,
        server: Server,
        session: Session,
        tasks: Tasks,
        animation: Callable[[], Animation],
        opening: Opening,
    ) -> None:
        """Keeps nothing until it `begin`s.

        Args:
            server: whose visitors do what is kept.
            session: what is kept.
            tasks: beside it, whose runs are.
            animation: how what moves is drawn now.
            opening: with which the session was opened.
        """
        self._server, self._session, self._tasks = server, session, tasks
        self._animation = animation
        self.camera: CameraPose | None = opening.camera
        """Where somebody in control left one; None: nobody has."""
        self.title: SessionTitle = SessionTitle(opening.title)
        self._recorder: Recorder | None = None
        self._put_picture: Callable[[bytes, str], object] | None = None

    def begin(
        self,
        study: StudyFile,
        name: SessionId,
        tell_trouble: Callable[[str], None],
        ended: Callable[[Run], None],
    ) -> None:
        """Keeps all that is done from now on.

        Args:
            study: where.
            name: under which the study file knows the session.
            tell_trouble: told what keeps it from being saved; "" once nothing does.
            ended: given every run that was kept.
        """
        acting = self._server.visitors.acting
        self._recorder = Recorder(self._session, study, name, acting, self._server.mistake)
        self._end_watching = study.watch(tell_trouble)
        self.title.keep_in(partial(study.name, name))
        RunRecorder(study, name, self.author, self._tasks.by_kind, ended)
        self._put_picture = lambda png, caption: study.put_picture(name, png, caption, self.author())

    def author(self) -> str:
        """Return the name of who does something in this thread."""
        return self._server.visitors.acting().name

    def leave(self, camera: CameraPose | None) -> None:
        """Keeps where a camera was left."""
        if camera != self.camera:
            self.camera = camera
            self.keep_view()

    def keep_view(self) -> None:
        """Keeps how pages show the session."""
        if self._recorder:
            self._recorder.see(PageView(self._animation(), self.camera))

    def keep_picture(self, png: bytes, caption: str) -> None:
        """Keeps a picture of the scene."""
        if self._put_picture:
            self._put_picture(png, caption)

    def close(self) -> None:
        """Writes what is left and ends."""
        if self._recorder:
            self._recorder.close()
            self._end_watching()
