"""Left column: the mount groups and their rates."""

import math
from collections.abc import Callable

import viser

from modeviz.export.wording import sentence_case, signed
from modeviz.units import factor
from modeviz.vehicle.connections import DIRECTIONS, RATE_FIELDS, MountGroup, MountRates, Rates
from modeviz.viewer.answers import Solved
from modeviz.viewer.assign import assign
from modeviz.viewer.session import Session
from modeviz.viewer.settle import WriteBack
from modeviz.viewer.state import known_sets

PER_MM = factor("N/mm", "stiffness")


class MountsPanel:
    """A folder for each mount group with a slider, N/mm, for each direction."""

    def __init__(self, gui: viser.GuiApi, session: Session, set_rates: Callable[[Rates], None]) -> None:
        """Builds the controls.

        Args:
            gui: where.
            session: what the sliders change.
            set_rates: sets rates in the session and on every slider.
        """
        self._vehicle, self._session = session.vehicle, session
        self._write_back = WriteBack()
        self._folders: dict[str, viser.GuiFolderHandle] = {}
        self._sliders: dict[tuple[str, str], viser.GuiInputHandle[float]] = {}
        self._labelled: dict[str, MountRates] = {}
        if self._vehicle.mount_groups:
            self._add_presets(gui, set_rates)
        for group in self._vehicle.mount_groups:
            self._add_group(gui, group)

    def set_rates(self, rates: Rates) -> None:
        """Puts rates that were not chosen with a slider on the sliders."""
        for group, its_rates in rates.items():
            for name in RATE_FIELDS:
                self._sliders[group, name].value = getattr(its_rates, name) / PER_MM

    def show(self, solved: Solved) -> None:
        """Marks what was changed, and each group's share of the shown mode's energy."""
        shown = solved.name.spoken
        for group in self._vehicle.mount_groups:
            share = solved.strain[group.name]
            energy = f"{100 * share:.0f} % of {shown} energy"
            assign(self._folders[group.name], label=f"{group.name}  {group.label}  ·  {energy}")
            if self._labelled.get(group.name) != solved.state.rates[group.name]:
                self._label_sliders(group, solved.state.rates[group.name])

    def _label_sliders(self, group: MountGroup, now: MountRates) -> None:
        self._labelled[group.name] = now
        for name, direction in zip(RATE_FIELDS, DIRECTIONS, strict=True):
            label = _label(direction, getattr(now, name), getattr(group.rates, name))
            assign(self._sliders[group.name, name], label=label)

    def _add_presets(self, gui: viser.GuiApi, set_rates: Callable[[Rates], None]) -> None:
        sets = known_sets(self._vehicle)
        load = gui.add_button_group("Load", tuple(sets), hint="Sets every rate to a known set")
        load.on_click(lambda _: set_rates(sets[load.value]))
        reset = gui.add_button_group(
            "Reset", ("Selected group", "All"), hint="Back to the vehicle's own rates"
        )

        @reset.on_click
        def _(_) -> None:
            own, group = self._vehicle.rates, self._session.state.group
            set_rates(own if reset.value == "All" else {group: own[group]})

    def _add_group(self, gui: viser.GuiApi, group: MountGroup) -> None:
        self._folders[group.name] = folder = gui.add_folder(f"{group.name}  {group.label}")
        with folder:
            for name, direction in zip(RATE_FIELDS, DIRECTIONS, strict=True):
                self._sliders[group.name, name] = self._add_slider(gui, group, name, direction)

    def _add_slider(
        self, gui: viser.GuiApi, group: MountGroup, name: str, direction: str
    ) -> viser.GuiInputHandle[float]:
        own = getattr(group.rates, name) / PER_MM
        softest, stiffest = (getattr(bound, name) / PER_MM for bound in group.bounds)
        start = getattr(self._session.state.rates[group.name], name) / PER_MM
        slider = gui.add_slider(
            sentence_case(direction),
            min=float(math.floor(min(softest, start))),
            max=float(math.ceil(max(stiffest, start))),
            step=1.0,
            initial_value=float(start),
            marks=(float(round(own)),),
            hint=f"{group.name} {group.label}, {direction} rate in N/mm; original {own:.0f}",
        )

        @slider.on_update
        def _(event: viser.GuiEvent) -> None:
            if event.client is None:
                return
            self._write_back.touch(slider)
            self._session.set_rate(group.name, name, slider.value * PER_MM)

        return slider


def _label(direction: str, now: float, own: float) -> str:
    """A direction, and its change in percent where there is one."""
    percent = 100 * (now / own - 1) if own else 0.0
    change = f"  {signed(percent, 0, ' %')}" if abs(percent) >= 0.5 else ""
    return sentence_case(direction) + change
