"""What the page asks of files beside their content."""

from dataclasses import dataclass

import viser

from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.formats.places import FORMS
from modeviz.formats.poses import FORMS as POSE_FORMS
from modeviz.viewer.inspection.putting import Asked

RESIDUAL_FORM = "NAME=X,Y,Z along x, y and z, length over force in the files' units"

AS_THE_FILES_SAY = "As the files say"


@dataclass(frozen=True)
class ImportFields:
    """What is asked of the files beside their content."""

    units: viser.GuiDropdownHandle[str]
    name: viser.GuiTextHandle
    attach: viser.GuiTextHandle
    pose: viser.GuiTextHandle
    residual: viser.GuiTextHandle
    replaces: viser.GuiCheckboxHandle

    @classmethod
    def of(cls, gui: viser.GuiApi) -> "ImportFields":
        """Builds them, from top to bottom."""
        return cls(
            units=gui.add_dropdown(
                "Units", (AS_THE_FILES_SAY, *UNIT_SYSTEMS), hint="Of the files; they are never guessed"
            ),
            name=gui.add_text("Name", "", hint="Of the body in the vehicle"),
            attach=gui.add_text(
                "Attachments",
                "",
                hint=f"Where others hold on to it, with semicolons between: {FORMS}",
            ),
            pose=gui.add_text("Place", "", hint=f"Where it stands in the vehicle: {POSE_FORMS}"),
            residual=gui.add_text(
                "Residual",
                "",
                hint=f"What the modes leave out, with semicolons between: {RESIDUAL_FORM}",
            ),
            replaces=gui.add_checkbox(
                "Replace", False, hint="The body of that name gets new modes, mesh and attachments"
            ),
        )

    @property
    def chosen_units(self) -> str | None:
        """The units, if some are chosen."""
        return None if self.units.value == AS_THE_FILES_SAY else self.units.value

    def asked(self, usual_name: str) -> Asked:
        """Return what they say; a name that is the usual one has been given by nobody."""
        name = printed(self.name.value)
        return Asked(
            name=None if name == usual_name else name or None,
            usual_name=usual_name or "body",
            units=self.chosen_units,
            attach=_parts(self.attach.value),
            residual=_parts(self.residual.value),
            pose=printed(self.pose.value) or None,
            replace=self.replaces.value,
        )

    def clear(self) -> None:
        """Puts all back to what they were before there were files."""
        for text in (self.name, self.attach, self.pose, self.residual):
            text.value = ""
        self.units.value = AS_THE_FILES_SAY
        self.replaces.value = False


def _parts(text: str) -> tuple[str, ...]:
    """What stands between semicolons."""
    return tuple(filter(None, map(printed, text.split(";"))))


def printed(text: str) -> str:
    """Return text without what is no letter, such as half of one, and without blanks around it."""
    return "".join(filter(str.isprintable, text)).strip()
