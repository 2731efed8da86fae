"""What the modes of a body are held against, and how it is kept."""

from dataclasses import dataclass

import viser

from modeviz.files.records.decoupling import decoupling_text
from modeviz.text.wording import file_name
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.session.commands.decisions import ChangeTargets
from modeviz.viewer.session.session import Session

SAVE = "Save targets"
DECIMALS = 2


@dataclass(frozen=True)
class _Target:
    """A field of `Decoupling`, as a box shows it."""

    field: str
    label: str
    hint: str
    highest: float | None = None
    unit: float = 1.0
    """What one of the box's is in the field's."""


TARGETS = (
    _Target(
        "purity",
        "Purity, %",
        "The least part of one direction in the body's energy in a mode",
        100.0,
        0.01,
    ),
    _Target("lowest_frequency", "From, Hz", "No mode of the body should be below"),
    _Target("highest_frequency", "To, Hz", "No mode of the body should be above"),
    _Target("gap", "Gap, Hz", "How far apart any two of its modes should be"),
    _Target(
        "bounce_gap",
        "Bounce gap, Hz",
        "How far apart the modes should be in which it bounces, which the road excites, and in which "
        "it turns about its crank, which an engine excites, or of other bodies about their long axis",
    ),
)


class TargetsEditor:
    """Boxes for what is asked of a body's modes, folded up."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls."""
        self._gui, self._session = gui, session
        self._write_back = WriteBack()
        with gui.add_folder("Targets", expand_by_default=False):
            self._bindings = [self._box(target) for target in TARGETS]
            save = gui.add_button_group(
                "Keep",
                (SAVE,),
                hint="The targets as a file: its [decoupling] goes into the vehicle's vehicle.toml",
            )
        save.on_click(self._save)

    def show(self) -> None:
        """Brings the boxes after the state."""
        show_all(self._bindings)

    def _box(self, target: _Target) -> Binding:
        def read(state) -> float:
            return round(getattr(state.design.decoupling, target.field) / target.unit, DECIMALS)

        def write(value: float) -> None:
            self._session.do(ChangeTargets({target.field: value * target.unit}))

        box = self._gui.add_number(
            target.label,
            read(self._session.state),
            min=0.0,
            max=target.highest,
            step=0.5,
            hint=target.hint,
        )
        assign(box, precision=DECIMALS)
        return Binding(box, self._session, read, write, self._write_back, typed=True)

    def _save(self, event: viser.GuiEvent) -> None:
        """Gives the targets to the page that asked for them."""
        if event.client is None:
            return
        name = file_name(f"{self._session.vehicle.name} decoupling", "toml")
        text = decoupling_text(self._session.state.design.decoupling)
        event.client.send_file_download(name, text.encode(), save_immediately=True)
