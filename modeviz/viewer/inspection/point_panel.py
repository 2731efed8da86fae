"""Response points put into the vehicle folder from the page of bodies."""

import threading
from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path

import viser

from modeviz.errors import ModevizError
from modeviz.formats.response_points import add_response_point
from modeviz.text.wording import sentence_case
from modeviz.viewer.inspection.import_fields import printed
from modeviz.viewer.inspection.subject import Subject
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block

CENTER = "Centre of gravity"
"""Where a point on a rigid body is if nothing else is said."""

NONE = "–"
"""In place of bodies, or of attachments, where there are none."""


class PointPanel:
    """Asks where the vehicle's motion is felt, and writes it into its folder."""

    def __init__(
        self,
        gui: viser.GuiApi,
        folder: Path,
        lock: threading.Lock,
        added: Callable[[], None],
    ) -> None:
        """Builds the controls; `show` fills them.

        Args:
            gui: where.
            folder: of the vehicle.
            lock: held while something is put into it.
            added: called when a point has been put into it.
        """
        self._folder, self._lock, self._added = folder, lock, added
        self._subjects: dict[str, Subject] = {}
        self._section = gui.add_folder("Response point", visible=False)
        with self._section:
            self._name = gui.add_text("Name", "", hint='Such as "seat"; the first is the driver\'s')
            self._body: viser.GuiDropdownHandle[str] = gui.add_dropdown(
                "On", [NONE], hint="The body whose motion is felt there"
            )
            self._attachment: viser.GuiDropdownHandle[str] = gui.add_dropdown(
                "At", [NONE], hint="An attachment of the body"
            )
            self._place = gui.add_text(
                "Or at X,Y,Z",
                "",
                hint="In the axes and the unit of length of vehicle.toml; on a flexible body within "
                "0.1 m of an attachment",
            )
            add = gui.add_button("Add the response point", icon=viser.Icon.MAP_PIN_PLUS)
            self._said = gui.add_html("")
        self._body.on_update(lambda _: self._offer_attachments())
        add.on_click(self._add)

    def show(self, subjects: Sequence[Subject]) -> None:
        """Offers the bodies of the vehicle."""
        self._subjects = {subject.name: subject for subject in subjects}
        assign(self._section, visible=bool(subjects))
        _offer(self._body, tuple(self._subjects))
        self._offer_attachments()

    def _offer_attachments(self) -> None:
        subject = self._subjects.get(self._body.value)
        is_rigid = subject is not None and not subject.modes
        _offer(
            self._attachment,
            (CENTER,) if is_rigid else tuple(mark.name for mark in subject.marks) if subject else (),
        )

    def _add(self, event: viser.GuiEvent) -> None:
        if event.client is None:
            return
        name, place = printed(self._name.value), printed(self._place.value)
        at = "" if self._attachment.value in (CENTER, NONE) else self._attachment.value
        try:
            with self._lock:
                add_response_point(self._folder, name, self._body.value, place or at)
        except ModevizError as error:
            self._say(f'<div class="bad">{escape(sentence_case(str(error)))}</div>')
            return
        self._name.value = self._place.value = ""
        self._say(f"<div>{escape(f'Response point {name}: in the vehicle.')}</div>")
        self._added()

    def _say(self, words: str) -> None:
        assign(self._said, content=block(words))


def _offer(dropdown: viser.GuiDropdownHandle[str], names: Sequence[str]) -> None:
    """Gives a dropdown other choices, if they are others."""
    options = tuple(names) or (NONE,)
    if tuple(dropdown.options) != options:
        dropdown.options = options
