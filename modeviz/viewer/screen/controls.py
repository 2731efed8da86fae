"""The left column: all that an engineer changes, keeps and takes away."""

import viser

from modeviz.viewer.page.widgets.hotkeys import Hotkeys
from modeviz.viewer.page.widgets.layout import NARROW, WIDE
from modeviz.viewer.panels.data_files import DataPanel
from modeviz.viewer.panels.mounts.history_row import HistoryRow
from modeviz.viewer.panels.mounts.opener import FolderOpener
from modeviz.viewer.panels.mounts.panel import MountsPanel
from modeviz.viewer.panels.notes import NotesPanel
from modeviz.viewer.panels.optimise.earlier import EarlierRuns
from modeviz.viewer.panels.optimise.panel import OptimisePanel
from modeviz.viewer.panels.pictures import PicturePanel
from modeviz.viewer.panels.scatter import ScatterPanel
from modeviz.viewer.panels.status import StatusPanel
from modeviz.viewer.panels.trade_off import TradeOffPanel
from modeviz.viewer.panels.variants import VariantsPanel
from modeviz.viewer.panels.view import ViewPanel
from modeviz.viewer.scene.stage import DARK, LIGHT
from modeviz.viewer.screen.page_parts import PageParts
from modeviz.viewer.session.answers import Solved

WIDTHS = {WIDE: 376, NARROW: 300}
"""Pixels; see `layout`."""


class Controls:
    """The tabs of the column, what is above them and below."""

    def __init__(self, parts: PageParts, hotkeys: Hotkeys) -> None:
        """Builds them; undo and redo are added to the keys."""
        gui, session, scene, tasks = parts.server.gui, parts.session, parts.scene, parts.tasks
        documents, keeping, dark = parts.documents, parts.keeping, parts.dark
        gui.main_panel.dock_left()
        self.history: HistoryRow = HistoryRow(gui, session, hotkeys)
        self.opener: FolderOpener = FolderOpener(gui)
        tabs = gui.add_tab_group()
        with tabs.add_tab("Mounts", viser.Icon.ADJUSTMENTS):
            self.mounts: MountsPanel = MountsPanel(gui, session)
        with tabs.add_tab("Variants", viser.Icon.VERSIONS):
            self.variants: VariantsPanel = VariantsPanel(gui, session)
            self.notes: NotesPanel = NotesPanel(gui, session)
        with tabs.add_tab("Optimise", viser.Icon.TARGET_ARROW):
            self.optimise: OptimisePanel = OptimisePanel(gui, session, tasks.search, dark)
            self.trade_off: TradeOffPanel = TradeOffPanel(gui, session, tasks.front)
            self.scatter: ScatterPanel = ScatterPanel(gui, session, tasks.scatter)
            self.earlier: EarlierRuns = EarlierRuns(
                gui, session, tasks.front, tasks.scatter, parts.opening.runs
            )
        with tabs.add_tab("View", viser.Icon.EYE):
            self.view: ViewPanel = ViewPanel(gui, session, scene.look, documents.link)
        with tabs.add_tab("Pictures", viser.Icon.CAMERA):
            self.pictures: PicturePanel = PicturePanel(
                gui,
                parts.server,
                DARK if dark else LIGHT,
                documents.subject,
                lambda: scene.driver.is_real,
                documents.color_scale,
                documents.offline,
                documents.illustrated_report,
                lambda png, prefix: keeping.keep_picture(png, f"{prefix}{documents.caption()}"),
            )
            self.data: DataPanel = DataPanel(gui, session, self.pictures.downloads, documents.solved)
        self.status: StatusPanel = StatusPanel(gui, session.vehicle.notes, parts.opening.remarks)

    def show_check(self, solved: Solved) -> None:
        """Says what is known by now of an answer that is drawn already."""
        self.status.show(solved)
        self.mounts.show_effects(solved)

    def show(self, solved: Solved) -> None:
        """Brings them after an answer; of one that is not detailed, what is held by hands alone."""
        self.status.show(solved)
        self.opener.show(solved.state.group)
        self.mounts.show(solved)
        if solved.is_detailed:
            self.history.show(solved.state)
            self.variants.show(solved)
            self.notes.show(solved)
            self.optimise.show(solved)
            self.trade_off.follow()
            self.scatter.follow()
            self.view.show()
