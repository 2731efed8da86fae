"""The page as a whole: opens the server, lays out the panels and draws every answer."""

from collections.abc import Callable, Sequence
from datetime import date
from functools import cache, partial

import viser

from modeviz.analysis.results import Conditions
from modeviz.analysis.rubber import dynamic_groups
from modeviz.errors import ModevizError
from modeviz.journal.fingerprint import fingerprint_of
from modeviz.journal.sessions import SessionId
from modeviz.journal.study_file import StudyFile
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html import Picture, report
from modeviz.text.log import our_mistake
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.offline import offline_page
from modeviz.viewer.page import scripts
from modeviz.viewer.page.alerts import alert, withdraw
from modeviz.viewer.page.binding import READ_WITHIN
from modeviz.viewer.page.hotkeys import Hotkeys
from modeviz.viewer.page.html import style_sheet
from modeviz.viewer.page.layout import NARROW, WIDE, Layout
from modeviz.viewer.page.server import Server
from modeviz.viewer.page.theme import choose_theme
from modeviz.viewer.page.title import Title
from modeviz.viewer.panels.animation import AnimationCard
from modeviz.viewer.panels.data_files import DataPanel
from modeviz.viewer.panels.energy import EnergyPanel
from modeviz.viewer.panels.engine import EnginePanel
from modeviz.viewer.panels.excitation import ExcitationPanel
from modeviz.viewer.panels.figures import TablePanel
from modeviz.viewer.panels.forces import ForcesPanel
from modeviz.viewer.panels.guide import Guide
from modeviz.viewer.panels.modes import ModesPanel, StepMode, listed
from modeviz.viewer.panels.mounts.history_row import HistoryRow
from modeviz.viewer.panels.mounts.opener import FolderOpener
from modeviz.viewer.panels.mounts.panel import MountsPanel
from modeviz.viewer.panels.notes import NotesPanel
from modeviz.viewer.panels.optimise.earlier import EarlierRuns
from modeviz.viewer.panels.optimise.panel import OptimisePanel
from modeviz.viewer.panels.paths import PathsPanel
from modeviz.viewer.panels.pictures import PicturePanel
from modeviz.viewer.panels.response import ResponsePanel
from modeviz.viewer.panels.review.panel import ReviewPanel
from modeviz.viewer.panels.rigid.panel import RigidPanel
from modeviz.viewer.panels.rubber import RubberPanel
from modeviz.viewer.panels.scatter import ScatterPanel
from modeviz.viewer.panels.shape import ShapePanel
from modeviz.viewer.panels.statics import StaticPanel
from modeviz.viewer.panels.status import StatusPanel
from modeviz.viewer.panels.trade_off import TradeOffPanel
from modeviz.viewer.panels.variants import VariantsPanel
from modeviz.viewer.panels.view import ViewPanel
from modeviz.viewer.scene.mount_handle import Dragged
from modeviz.viewer.scene.scene import Scene
from modeviz.viewer.scene.stage import DARK, LIGHT
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.coloring import color_scale
from modeviz.viewer.session.commands.decisions import DragMounts, Swap
from modeviz.viewer.session.commands.looks import SelectGroup
from modeviz.viewer.session.cursor import has_ride, is_shaken
from modeviz.viewer.session.design import variant_name
from modeviz.viewer.session.encoding.link import link_of
from modeviz.viewer.session.notifications import Answered, Checked, Failed, Notification, Preparing
from modeviz.viewer.session.opening import Opening
from modeviz.viewer.session.recorder import Recorder
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.session_title import SessionTitle
from modeviz.viewer.session.shared import Shared
from modeviz.viewer.session.state import first_state
from modeviz.viewer.session.view import CameraPose, PageView
from modeviz.viewer.session.worker import StuckError
from modeviz.viewer.tasks.front_task import FrontTask
from modeviz.viewer.tasks.run_recorder import RunRecorder
from modeviz.viewer.tasks.scatter_task import ScatterTask
from modeviz.viewer.tasks.search_task import SearchTask

LEFT = {WIDE: 376, NARROW: 300}
RIGHT = {WIDE: 484, NARROW: 380}
CARD = {WIDE: 380, NARROW: 300}
"""Pixels; see `layout`."""

NOT_SOLVED = "not solved"
"""The notice that what is asked for has no answer."""

BACK = " You are back at the last state that was solved."


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
        self.server: Server = server
        self._fingerprint = cache(lambda: fingerprint_of(vehicle).digest)
        self._gui = server.gui
        self._title, self._dark = Title(server), dark
        opening = opening or Opening(first_state(vehicle, rates, conditions))
        state, self._opening = opening.state, opening
        self.session: Session = Session(
            vehicle,
            state,
            self._hear,
            past=opening.past,
            future=opening.future,
            shared=shared,
            acting=server.visitors.acting,
        )
        session, mistake = self.session, server.mistake
        self.search_task: SearchTask = SearchTask(session, lambda: self._optimise.follow(), mistake)
        self.front_task: FrontTask = FrontTask(session, lambda: self._trade_off.follow(), mistake)
        self.scatter_task: ScatterTask = ScatterTask(session, lambda: self._scatter.follow(), mistake)
        scripts.run(self._gui, "page/style.js", style_sheet())
        scripts.run(self._gui, "page/delivery.js")
        scripts.run(self._gui, "page/numbers.js")
        scripts.run(self._gui, "page/zoom.js")
        scripts.run(self._gui, "page/no_drop.js")
        choose_theme(self._gui, dark)
        self._left = opening.camera
        self._named = SessionTitle(opening.title)
        self._recorder: Recorder | None = None
        self._scene = Scene(
            server, self.session.vehicle, dark, self._select, opening.camera, self._leave
        )
        self._scene.let_drag(self._drag, mistake, server.visitors.has_control)
        self._hotkeys = Hotkeys(self._gui)
        self._pictured: Callable[[bytes, str], object] | None = None
        self._lay_out(dark)

    def start(self, progress: Callable[[float], None] | None = None) -> None:
        """Prepares the vehicle, which the page shows, and asks for the first answer.

        Args:
            progress: told the fraction of the preparation that is done as well.

        Raises:
            ModevizError: there is no answer on that road at that speed.
        """

        def tell(fraction: float) -> None:
            self._status.show_progress(fraction)
            if progress:
                progress(fraction)

        self.session.start(tell)

    def record(self, study: StudyFile, name: SessionId) -> None:
        """Keeps all that is done from now on in a study file, until the end; see `Recorder`.

        Args:
            study: where; what keeps it from being saved is said on every page.
            name: under which the study file knows the session.
        """
        acting = self.server.visitors.acting
        self._recorder = Recorder(self.session, study, name, acting, self.server.mistake)
        self._end_watching = study.watch(self._show_trouble)

        def author() -> str:
            return acting().name

        RunRecorder(
            study,
            name,
            author,
            {"search": self.search_task, "front": self.front_task, "scatter": self.scatter_task},
            self._earlier.add,
        )
        self._pictured = lambda png, caption: study.put_picture(name, png, caption, author())
        self._notes.keep_in(study, name, author)
        self._named.keep_in(partial(study.name, name))

    def _show_trouble(self, trouble: str) -> None:
        """Says on every page why what is done is not saved; "" once it is."""
        self._status.show_trouble(trouble)
        self.server.flush()

    @property
    def scene(self) -> Scene:
        """The scene in the middle of every page."""
        return self._scene

    @property
    def is_busy(self) -> bool:
        """Whether a search or something like it is at work, which nobody need look at."""
        jobs = (task.job for task in (self.search_task, self.front_task, self.scatter_task))
        return any(job is not None and job.is_running for job in jobs)

    def offline(self, position: Floats, look_at: Floats) -> bytes:
        """Return what is shown as a file that needs no server, see `offline_page`.

        Args:
            position: of the camera it opens with, m.
            look_at: what that looks at, m.

        Raises:
            ModevizError: nothing is shown yet.
        """
        solved = self._solved()
        variant = variant_name(self.session.vehicle, solved.state.design)
        with self._scene.without_handle():
            return offline_page(self.server, solved, variant, self._dark, position, look_at)

    def link(self, camera: CameraPose) -> str:
        """Return what is shown as a text that `opening_of_link` reads.

        Args:
            camera: from where it is seen.

        Raises:
            ModevizError: it does not fit into an address.
        """
        session, fingerprint = self.session, self._fingerprint()
        return link_of(session.state, self._animation.animation, camera, session.vehicle, fingerprint)

    def report(self, pictures: Sequence[Picture]) -> bytes:
        """The present rates against the set they are compared with, see `report.html`.

        Raises:
            ModevizError: nothing is shown yet.
        """
        solved = self._solved()
        vehicle, state = self.session.vehicle, solved.state
        name = variant_name(vehicle, state.design)
        now = RateSet(name if name != state.against else f"{name}, now", state.design.rates)
        base = RateSet(state.against, solved.base.rates)
        conditions = state.conditions if has_ride(vehicle) else None
        comparison = compare(
            solved.now.prepared, base, now, conditions, solved.base.prepared, self.session.original
        )
        check, remarks = solved.findings.check, self._notes.notes
        return report(comparison, date.today(), pictures, check, remarks).encode()

    def end(self) -> None:
        """Ends the session, and what may be running in it."""
        self.search_task.close()
        self.front_task.cancel()
        self.scatter_task.cancel()
        self._scene.close()
        self._review.close()
        self.session.close()
        if self._recorder:  # last: until pages are told, they go on
            self._recorder.close()
            self._end_watching()

    def close(self) -> None:
        """Ends the session and the server, also where the first goes wrong."""
        try:
            self.end()
        finally:
            self.server.stop()

    def _lay_out(self, dark: bool) -> None:
        self._forces: ForcesPanel | None = None
        self._paths: PathsPanel | None = None
        gui, session = self._gui, self.session
        gui.main_panel.dock_left()
        self._history = HistoryRow(gui, session, self._hotkeys)
        self._opener = FolderOpener(gui)
        tabs = gui.add_tab_group()
        with tabs.add_tab("Mounts", viser.Icon.ADJUSTMENTS):
            self._mounts = MountsPanel(gui, session)
        with tabs.add_tab("Variants", viser.Icon.VERSIONS):
            self._variants = VariantsPanel(gui, session)
            self._notes = NotesPanel(gui, session)
        with tabs.add_tab("Optimise", viser.Icon.TARGET_ARROW):
            self._optimise = OptimisePanel(gui, session, self.search_task, dark)
            self._trade_off = TradeOffPanel(gui, session, self.front_task)
            self._scatter = ScatterPanel(gui, session, self.scatter_task)
            self._earlier = EarlierRuns(
                gui, session, self.front_task, self.scatter_task, self._opening.runs
            )
        with tabs.add_tab("View", viser.Icon.EYE):
            self._view = ViewPanel(gui, session, self._scene.look, self.link)
        with tabs.add_tab("Pictures", viser.Icon.CAMERA):
            theme = DARK if dark else LIGHT
            self._pictures = PicturePanel(
                gui,
                self.server,
                theme,
                self._subject,
                lambda: self._scene.driver.is_real,
                lambda: self._scene.color_scale(self._solved()),
                self.offline,
                self._illustrated_report,
                self._keep_picture,
            )
            self._data = DataPanel(gui, session, self._pictures.downloads, self._solved)
        self._status = StatusPanel(gui, session.vehicle.notes, self._opening.remarks)
        self.guide: Guide = Guide(self.server, self._hotkeys)
        self._review = ReviewPanel(self.server, self._scene.following.switch, self._named)
        self.server.visitors.on_change(self._scene.following.look_again)

        right = gui.add_panel()
        with right.add_tab("Response", viser.Icon.CHART_LINE):
            self._response = ResponsePanel(gui, session, self.scatter_task, dark)
            tabs = gui.add_tab_group()
            with tabs.add_tab("Modes", viser.Icon.WAVE_SINE):
                self._modes = ModesPanel(gui, session)
            with tabs.add_tab("Energy", viser.Icon.CHART_BAR):
                self._energy = EnergyPanel(gui, session)
            if is_shaken(session.vehicle) and session.vehicle.mounts:
                with tabs.add_tab("Forces", viser.Icon.ARROWS_VERTICAL):
                    self._forces = ForcesPanel(gui, session)
            if is_shaken(session.vehicle) and session.vehicle.response_points:
                with tabs.add_tab("Paths", viser.Icon.ROUTE):
                    self._paths = PathsPanel(gui, session)
        self._of_ride: list[TablePanel | ExcitationPanel] = []
        if session.state.charts.curves:
            with right.add_tab("Figures", viser.Icon.TABLE):
                self._of_ride.append(TablePanel(gui))
        if session.state.charts.curves or is_shaken(session.vehicle):
            with right.add_tab("Road" if has_ride(session.vehicle) else "Load", viser.Icon.ROAD):
                self._of_ride.append(ExcitationPanel(gui, session))
        self._engine: EnginePanel | None = None
        if session.vehicle.engines and (session.vehicle.response_points or session.vehicle.mounts):
            with right.add_tab("Engine", viser.Icon.ENGINE):
                self._engine = EnginePanel(gui, session, dark)
        with right.add_tab("Rigid", viser.Icon.AXIS_X):
            self._rigid = RigidPanel(gui, session)
        with right.add_tab("Static", viser.Icon.ARROW_BAR_TO_DOWN):
            self._static = StaticPanel(gui, session)
        self._rubber: RubberPanel | None = None
        if dynamic_groups(session.vehicle):
            with right.add_tab("Rubber", viser.Icon.WAVE_SAW_TOOL):
                self._rubber = RubberPanel(gui, session, dark)
        right.dock_right()

        card = gui.add_panel()
        with card.add_tab("Motion", viser.Icon.PLAYER_PLAY):
            driver, animation = self._scene.driver, self._opening.animation
            self._animation = AnimationCard(gui, driver, self._step_mode, animation, self._keep_view)
        with card.add_tab("What moves", viser.Icon.WAVE_SINE):
            self._shape = ShapePanel(gui, session)
        card.float(x=24, y=-24)
        Layout(self.server, ((gui.main_panel, LEFT), (right, RIGHT), (card, CARD)))
        self._hotkeys.add("Play or pause", "space", lambda event: self._animation.toggle(event.client))
        self._hotkeys.add("Next mode", "N", lambda _: self._step_mode(1))
        self._hotkeys.add("Mode before", "P", lambda _: self._step_mode(-1))
        self._hotkeys.add("Swap with the set compared with", "B", lambda _: session.do(Swap()))

    def _hear(self, notification: Notification) -> None:
        """Puts what the session tells on every page."""
        match notification:
            case Answered(solved):
                self._show(solved)
                for client in self.server.get_clients().values():
                    withdraw(client, NOT_SOLVED)
            case Preparing(fraction):
                self._status.show_progress(fraction)
                self.server.flush()
            case Checked(solved):
                self._status.show(solved)
                self._mounts.show_effects(solved)
                self.server.flush()
            case Failed():
                self.tell_failure(notification)

    def _show(self, solved: Solved) -> None:
        """Draws an answer: the panels in one batch, the scene in another, which waits for a frame.

        While rates move, what has to be read is drawn only now and then.
        """
        with self.server.atomic():
            vehicle = self.session.vehicle
            self._title.show(vehicle.name, variant_name(vehicle, solved.state.design))
            self._response.show(solved)
            self._animation.show(solved.movement, color_scale(solved))
            self._shape.show(solved)
            self._status.show(solved)
            self._opener.show(solved.state.group)
            self._mounts.show(solved)
            if solved.is_detailed:
                self._history.show(solved.state)
                for panel in self._of_ride:
                    panel.show(solved)
                self._variants.show(solved)
                self._notes.show(solved)
                self._optimise.show(solved)
                self._trade_off.follow()
                self._scatter.follow()
                self._view.show()
                self._modes.show(solved)
                self._energy.show(solved)
                self._rigid.show(solved)
                self._static.show(solved)
                if self._rubber:
                    self._rubber.show(solved)
                if self._engine:
                    self._engine.show(solved)
                if self._forces:
                    self._forces.show(solved)
                if self._paths:
                    self._paths.show(solved)
        self.server.flush()
        self._scene.hold(self.session.with_parts_of(solved.state), solved.now.prepared.vehicle)
        self._scene.show(solved)
        self._scene.place(self.session.state)
        self._static.tell_scale(solved, self._scene.exaggeration)

    def _solved(self) -> Solved:
        if self.session.answer is None:
            raise ModevizError("nothing is solved yet: try again when the preparation is done")
        return self.session.answer

    def _leave(self, client_id: int, camera: CameraPose | None) -> None:
        """Notes where who is in control left a camera."""
        if self.server.visitors.has_control(client_id) and camera != self._left:
            self._left = camera
            self._keep_view()

    def _keep_view(self) -> None:
        """Keeps how pages show the session in the study, if there is one."""
        if self._recorder:
            self._recorder.see(PageView(self._animation.animation, self._left))

    def _keep_picture(self, png: bytes, prefix: str) -> None:
        """Keeps a picture of the scene in the study, if there is one."""
        if self._pictured:
            solved = self._solved()
            variant = variant_name(self.session.vehicle, solved.state.design)
            self._pictured(png, f"{prefix}{solved.movement.heading}, {variant}")

    def _illustrated_report(self, png: bytes) -> bytes:
        """The report with a picture of the scene as it is."""
        solved = self._solved()
        moving, variant = solved.movement, variant_name(self.session.vehicle, solved.state.design)
        caption = f"{moving.heading}, {variant}"
        return self.report([Picture(caption, png)])

    def tell_failure(self, failed: Failed) -> None:
        """Says what went wrong; the last good answer stays on the screen."""
        error, name = failed.error, NOT_SOLVED
        text = str(error)
        if not isinstance(error, ModevizError):
            name = self.server.note_mistake(error)
            hangs = f"{text[:1].upper()}{text[1:]}. " if isinstance(error, StuckError) else ""
            text = f"{hangs}{our_mistake(name)}{BACK if failed.is_back else ''}"
        for client in self.server.get_clients().values():
            alert(client, name, "Not solved", text)

    def _select(self, group: str) -> None:
        self._opener.ask()
        self.session.do(SelectGroup(group))

    def _step_mode(self, step: int) -> None:
        last = self.session.answer
        if last and listed(last.now):
            self.session.do(StepMode(last, step))

    def _drag(self, dragged: Dragged) -> None:
        """Puts the mounts of a group where their handle is, unless that is off a body: then nowhere."""
        try:
            self.session.do(DragMounts(dragged.group, dragged.placement, dragged.drag))
        except ModevizError as refusal:
            if dragged.is_over and dragged.client is not None:
                dragged.client.add_notification(
                    "Not possible", str(refusal), color="red", auto_close_seconds=READ_WITHIN
                )
        self._scene.place(self.session.state)

    def _subject(self) -> str:
        """Return the subject of a picture: "Pickup cab yaw"."""
        last = self.session.answer
        return f"{self.session.vehicle.name} {last.movement.subject if last else ''}"
