"""Left column: what is on the screen as files for other programs."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import viser

from modeviz.export.catalogue import body_words, contents
from modeviz.export.solution import ExportOptions, Solution
from modeviz.export.writers import Writer
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.text.wording import file_name, told_apart
from modeviz.vehicle.absorbers import carrying_bodies
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.panels.downloads import Downloads
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.cursor import has_ride
from modeviz.viewer.session.design import variant_name
from modeviz.viewer.session.session import Session
from modeviz.viewer.tasks.page_jobs import Progress

CONTENTS = {
    "Mount rates": "rates",
    "Mounts": "mounts",
    "Modes": "modes",
    "Modes with damping": "complex-modes",
    "Motion of the mode shown": "motion",
    "Spectra on the road": "psd",
    "Frequency responses": "frf",
    "All bodies": "bodies",
    "Vehicle folder": "vehicle",
}
"""What can be written of any vehicle, by what it is called here."""

FORMATS = {
    "CSV": ".csv",
    "JSON": ".json",
    "Nastran cards": ".bdf",
    "Universal file, 2414": ".unv",
    "Universal file, 55": ".uff",
    "NumPy, NPZ": ".npz",
    "ParaView, VTU": ".vtu",
    "glTF, GLB": ".glb",
    "Folder, ZIP": ".zip",
}
"""The endings of files, by what their formats are called; of Nastran's one of several."""

FUNCTION_FORMATS = {"CSV": ".csv", "Universal file, 58": ".uff"}
"""The same of functions over frequency."""

CARDS = "Nastran cards"
"""The only format in units that are chosen."""


class DataPanel:
    """Chooses what is written, in which format and units, and downloads it."""

    def __init__(
        self,
        gui: viser.GuiApi,
        session: Session,
        downloads: Downloads,
        solved: Callable[[], Solved],
    ) -> None:
        """Builds the controls.

        Args:
            gui: where.
            session: whose vehicle it is.
            downloads: makes files for pages.
            solved: gives the answer that is shown; raises ModevizError if there is none.
        """
        self._downloads, self._solved = downloads, solved
        self._choices = _choices(session.vehicle)
        first = next(iter(self._choices))
        with gui.add_folder("Data"):
            self._content = gui.add_dropdown(
                "Content",
                tuple(self._choices),
                hint="With the rates and the road on the screen; of a body its own free modes",
            )
            self._format = gui.add_dropdown(
                "Format", tuple(self._choices[first]), hint="What is in it: docs/export.md"
            )
            self._units = gui.add_dropdown(
                "Units",
                tuple(dict.fromkeys([ExportOptions.units, *UNIT_SYSTEMS])),
                hint="Of Nastran cards; other files are in SI, and tables of rates in N/mm",
            )
            button = gui.add_button(
                "Download", icon=viser.Icon.DOWNLOAD, hint="Makes the file and downloads it"
            )
        self._content.on_update(lambda _: self._offer())
        self._format.on_update(lambda _: self._show_units())
        button.on_click(lambda event: self._begin(event.client))
        self._show_units()

    def _offer(self) -> None:
        """Offers the formats of the content that is chosen, the one before if it is among them."""
        formats, before = tuple(self._choices[self._content.value]), self._format.value
        self._format.options = formats
        self._format.value = before if before in formats else formats[0]
        self._show_units()

    def _show_units(self) -> None:
        assign(self._units, visible=self._format.value == CARDS)

    def _begin(self, client: viser.ClientHandle | None) -> None:
        """Begins to make the file that is chosen."""
        content, kind = self._content.value, self._format.value
        file = self._choices[content].get(kind)
        if file is not None:  # else its page has not heard yet what there is of another content
            options = ExportOptions(units=self._units.value)
            self._downloads.begin(client, f"{content}: {kind}", partial(self._made, file, options))

    def _made(
        self, file: "_File", options: ExportOptions, client: viser.ClientHandle, tell: Progress
    ) -> tuple[str, bytes]:
        """The name and the content of a file; what is left out is told its page."""
        tell(0.0)
        solved = self._solved()

        def note(text: str) -> None:
            client.add_notification("Left out", text, color="orange")

        shown = replace(options, mode=solved.followed.name.name)
        made = file.write(_solution(solved, note), shown)
        vehicle = solved.now.prepared.vehicle
        variant = variant_name(vehicle, solved.state.design)
        return file_name(f"{vehicle.name} {variant} {file.word}", file.ending), made


@dataclass(frozen=True)
class _File:
    """A content in a format."""

    word: str
    """What a file's name calls it."""
    ending: str
    """Without the point."""
    write: Writer


def _choices(vehicle: Vehicle) -> dict[str, dict[str, _File]]:
    """What there is of a vehicle by what it is called, and for each the formats likewise."""
    words = body_words(vehicle)
    bodies = {label: words[name] for label, name in told_apart(carrying_bodies(vehicle)).items()}
    writers = contents(vehicle)
    missing = set() if vehicle.mount_groups else {"rates", "mounts"}
    missing |= set() if vehicle.response_points else {"frf"}
    missing |= set() if has_ride(vehicle) else {"psd"}
    return {
        label: {
            name: _File(word, ending[1:], writers[word][ending])
            for name, ending in (FUNCTION_FORMATS if word in ("psd", "frf") else FORMATS).items()
            if ending in writers[word]
        }
        for label, word in {**CONTENTS, **bodies}.items()
        if word not in missing
    }


def _solution(solved: Solved, note: Callable[[str], None]) -> Solution:
    """What is on the screen, as it is written."""
    now, state = solved.now, solved.state
    return Solution(
        now.vehicle,
        state.design.rates,
        lambda: state.conditions,
        lambda _below: now,
        lambda: now.prepared,
        note,
    )
