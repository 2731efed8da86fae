"""Files of other programs dropped into the page: looked at, then put into the vehicle folder."""

import io
import threading
import zipfile
from collections.abc import Callable
from html import escape
from pathlib import Path, PurePath
from tempfile import TemporaryDirectory

import viser

from modeviz.errors import ModevizError
from modeviz.formats.component import Component
from modeviz.formats.endings import TAKEN
from modeviz.text.wording import sentence_case
from modeviz.viewer.inspection.import_fields import ImportFields
from modeviz.viewer.inspection.putting import Put, component_in, put
from modeviz.viewer.inspection.received import Received
from modeviz.viewer.page.server import Server
from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.page.widgets.handles import assign, name_of
from modeviz.viewer.page.widgets.html import block, heading, span
from modeviz.viewer.page.wire.uploads import take_files_of

TAB = "Import"
LARGEST_FILE = 200_000_000
"""Bytes of a file from a page; larger ones are for `modeviz import`."""

LABELS = {
    "--attach: ": "Attachments: ",
    "--pose: ": "Place: ",
    "--residual: ": "Residual: ",
    "--units: ": "Units: ",
    "--name: ": "Name: ",
    "with --replace": "with the box Replace",
    "--replace": "Replace",
    "with --name": "under Name",
}
"""What options are called here."""


class ImportPanel:
    """Takes files, asks for what they don't say, and puts their component into a vehicle folder."""

    def __init__(
        self,
        server: Server,
        folder: Path | None,
        look_at: Callable[[Component, str, str | None], None],
        added: Callable[[str], None],
    ) -> None:
        """Builds the controls.

        Args:
            server: of the pages.
            folder: of the vehicle; None: a new one is downloaded.
            look_at: shows a component that has come, under a name, in units if they are chosen.
            added: told the name of a body that has been put into the folder.
        """
        gui = server.gui
        self._server, self._folder = server, folder
        self._look_at, self._added = look_at, added
        self._received = Received()
        self.lock: threading.Lock = threading.Lock()
        """Held while something is put into the folder."""
        self._named = ""
        self._upload = self._upload_button()
        self._content = gui.add_html("")
        self._fields = ImportFields.of(gui)
        self._fields.units.on_update(self._redraw)
        self._add_buttons(gui)
        scripts.run(gui, "inspection/drop.js", name_of(self._upload), TAB)
        self._say(span(f"Drop files here: {', '.join(TAKEN)}", "dim"))

    def _upload_button(self) -> viser.GuiUploadButtonHandle:
        upload = self._server.gui.add_upload_button(
            "Choose a file…",
            icon=viser.Icon.UPLOAD,
            hint="Or drop files anywhere on the page; a component may be in several",
        )
        take_files_of(upload, LARGEST_FILE)
        upload.on_upload(self._take)
        return upload

    def _add_buttons(self, gui: viser.GuiApi) -> None:
        where = "Put it into the vehicle" if self._folder else "Download as a vehicle…"
        add = gui.add_button(where, icon=viser.Icon.PACKAGE_IMPORT, hint=self._destination())
        add.on_click(self._add)
        forget = gui.add_button(
            "Other files", icon=viser.Icon.X, color="gray", hint="Forgets the files that have come"
        )
        forget.on_click(lambda _: self._forget())
        if self._folder is not None:
            again = gui.add_button(
                "Read the folder again",
                icon=viser.Icon.REFRESH,
                color="gray",
                hint="After its vehicle.toml was changed elsewhere",
            )
            again.on_click(self._read_again)

    def close(self) -> None:
        """Deletes what has come."""
        self._received.close()

    def _destination(self) -> str:
        if self._folder is None:
            return "As a folder in a .zip file, for modeviz view"
        return f"Writes into {self._folder}"

    def _take(self, event: viser.GuiEvent) -> None:
        """Keeps a file that has come, and shows what there is now."""
        file = self._upload.value
        with self.lock:
            try:
                self._received.add(file.name, file.content)
                self._name_after(self._received.names[0])
                self._show()
            except ModevizError as error:
                self._refuse(error)

    def _name_after(self, file: str) -> None:
        """Calls the body as the first of its files, unless somebody has given it a name."""
        name = self._fields.name
        if name.value in ("", self._named):
            name.value = self._named = PurePath(file).stem

    def _redraw(self, event: viser.GuiEvent) -> None:
        if event.client is not None and self._received.names:
            with self.lock:
                try:
                    self._show()
                except ModevizError as error:
                    self._refuse(error)

    def _show(self) -> None:
        with self._received.told() as paths:
            component = component_in(paths)
        if component is not None:
            self._look_at(component, self._fields.name.value, self._fields.chosen_units)
        self._say(self._listed())

    def _add(self, event: viser.GuiEvent) -> None:
        """Puts the component into the folder, or into one that the page downloads."""
        client = event.client
        if client is None:
            return
        with self.lock:
            try:
                done = self._put(client)
            except ModevizError as error:
                self._refuse(error)
                return
            self._clear()
            notes = "".join(f'<div class="dim">{escape(note)}</div>' for note in done.notes)
            self._say(f"<div>{escape(sentence_case(done.what))}: in the vehicle.</div>", notes)

    def _put(self, client: viser.ClientHandle) -> Put:
        asked = self._fields.asked(self._named)
        if self._folder is not None:
            with self._received.told() as paths:
                done = put(paths, asked, self._folder)
            self._added(done.body)
            return done
        with TemporaryDirectory(prefix="modeviz-") as home:
            with self._received.told() as paths:
                done = put(paths, asked, folder := Path(home, "vehicle"))
            client.send_file_download("vehicle.zip", _zipped(folder), save_immediately=True)
        return done

    def _read_again(self, event: viser.GuiEvent) -> None:
        if event.client is None:
            return
        try:
            self._added("")
        except ModevizError as error:
            event.client.add_notification("Not read", str(error), color="red")

    def _forget(self) -> None:
        with self.lock:
            self._clear()
            self._say(span(f"Drop files here: {', '.join(TAKEN)}", "dim"))

    def _clear(self) -> None:
        self._received.clear()
        self._fields.clear()

    def _refuse(self, error: ModevizError) -> None:
        words = str(error)
        for option, label in LABELS.items():
            words = words.replace(option, label)
        self._say(self._listed(), f'<div class="bad">{escape(words)}</div>')

    def _listed(self) -> str:
        return heading("Files", escape(", ".join(self._received.names)))

    def _say(self, *content: str) -> None:
        assign(self._content, content=block(*content))


def _zipped(folder: Path) -> bytes:
    """A folder as a .zip file."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as file:
        for path in sorted(folder.rglob("*")):
            file.write(path, Path(folder.name, path.relative_to(folder)))
    return content.getvalue()
