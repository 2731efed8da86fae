"""All panels of a tuning page: laid out once, and brought after every answer."""

from functools import partial

from modeviz.viewer.page.widgets.hotkeys import Hotkeys
from modeviz.viewer.page.widgets.layout import Layout
from modeviz.viewer.page.widgets.title import Title
from modeviz.viewer.panels.guide import Guide
from modeviz.viewer.panels.modes import step_mode
from modeviz.viewer.panels.review.panel import ReviewPanel
from modeviz.viewer.screen import controls, motion, results
from modeviz.viewer.screen.controls import Controls
from modeviz.viewer.screen.motion import MotionCard
from modeviz.viewer.screen.page_parts import PageParts
from modeviz.viewer.screen.results import Results
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.decisions import Swap
from modeviz.viewer.session.design import variant_name


class Screen:
    """The panels around the scene, and their keys."""

    def __init__(self, parts: PageParts) -> None:
        """Builds all panels."""
        server, session, scene = parts.server, parts.session, parts.scene
        self._server, self._session = server, session
        self._title = Title(server)
        gui = server.gui
        self.hotkeys: Hotkeys = Hotkeys(gui)
        self.controls: Controls = Controls(parts, self.hotkeys)
        self.guide: Guide = Guide(server, self.hotkeys)
        self.review: ReviewPanel = ReviewPanel(server, scene.following.switch, parts.keeping.title)
        server.visitors.on_change(scene.following.look_again)
        self.results: Results = Results(gui, session, parts.tasks, parts.dark)
        self.motion: MotionCard = MotionCard(
            gui, session, scene.driver, parts.opening.animation, parts.keeping.keep_view
        )
        Layout(
            server,
            (
                (gui.main_panel, controls.WIDTHS),
                (self.results.panel, results.WIDTHS),
                (self.motion.panel, motion.WIDTHS),
            ),
        )
        self._add_hotkeys()

    def show(self, solved: Solved) -> None:
        """Draws an answer in one batch; while rates move, what has to be read only now and then."""
        with self._server.atomic():
            variant = variant_name(self._session.vehicle, solved.state.design)
            self._title.show(self._session.vehicle.name, variant)
            self.motion.show(solved)
            self.controls.show(solved)
            self.results.show(solved)
        self._server.flush()

    def show_check(self, solved: Solved) -> None:
        """Says how far the check of an answer is that is drawn already."""
        self.controls.show_check(solved)
        self._server.flush()

    def show_progress(self, fraction: float) -> None:
        """Says how far the preparation is."""
        self.controls.status.show_progress(fraction)
        self._server.flush()

    def show_trouble(self, trouble: str) -> None:
        """Says why what is done is not saved; "" once it is."""
        self.controls.status.show_trouble(trouble)
        self._server.flush()

    def close(self) -> None:
        """Ends what tells pages of one another."""
        self.review.close()

    def _add_hotkeys(self) -> None:
        step, add = partial(step_mode, self._session), self.hotkeys.add
        add("Play or pause", "space", lambda event: self.motion.animation.toggle(event.client))
        add("Next mode", "N", lambda _: step(1))
        add("Mode before", "P", lambda _: step(-1))
        add("Swap with the set compared with", "B", lambda _: self._session.do(Swap()))
