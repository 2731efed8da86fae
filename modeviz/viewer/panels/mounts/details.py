"""What there is to know of the selected mount group, and to do with it beyond its rates."""

from collections.abc import Sequence

import viser

from modeviz.report.rate_fields import direction, is_damping, sections
from modeviz.text.wording import signed
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, Rates
from modeviz.viewer.page.binding import Binding
from modeviz.viewer.page.widgets.handles import assign, mark
from modeviz.viewer.page.widgets.html import block, named, row, span, table
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.panels.mounts.effects import Effect, Effects
from modeviz.viewer.panels.mounts.placing import Placing
from modeviz.viewer.panels.mounts.rows import row_label
from modeviz.viewer.panels.mounts.signs import Signs
from modeviz.viewer.scene.mount_looks import has_springs
from modeviz.viewer.session.commands.decisions import LinkRates, SetLossFactor
from modeviz.viewer.session.cursor import has_ride
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

LOSS_STEP, LOSS_DECIMALS = 0.005, 3
LARGEST_LOSS = 0.5
"""The end of the slider, unless a group's own is larger: about that of the most damping rubbers."""

FELT = "RMS acceleration of the first response point"


class Details:
    """A table of what its rates do, locks and resets, its loss factor and whether ratios are kept."""

    def __init__(self, gui: viser.GuiApi, session: Session, group: MountGroup, signs: Signs) -> None:
        """Builds them, out of sight; `show` brings those of the selected group out.

        Args:
            gui: where.
            session: what they change.
            group: whose they are.
            signs: which act on the selected group.
        """
        self._session, self._group, self._signs = session, group, signs
        self._is_felt = has_ride(session.vehicle)
        self._part = gui.add_folder(None, visible=False)
        with self._part:
            self._table = gui.add_html("")
            self._loss = gui.add_slider(
                "Loss factor",
                0.0,
                max(LARGEST_LOSS, group.loss_factor, self._loss_factor(session.state)),
                LOSS_STEP,
                self._loss_factor(session.state),
                marks=(),
                hint=f"Damping of {group.name}: the part of the stiffness that loses energy",
                visible=any(map(has_springs, group.mounts)),
            )
            assign(self._loss, precision=LOSS_DECIMALS)
            self._linked = gui.add_checkbox(
                "Keep ratios",
                self._is_linked(session.state),
                hint=_linked_hint(group),
                visible=len(group.fields) > 1,
            )
            placing = Placing(gui, session, group)
        self.bindings: tuple[Binding[State], ...] = (
            *placing.bindings,
            Binding(
                self._loss,
                session,
                self._loss_factor,
                lambda factor: session.do(SetLossFactor(group.name, factor)),
                WriteBack(),
            ),
            Binding(
                self._linked,
                session,
                self._is_linked,
                lambda linked: session.do(LinkRates(group.name, linked)),
            ),
        )

    def show(self, state: State, compared: Rates, effects: Effects, mode: str, is_old: bool) -> None:
        """Brings the table up to date if this is the selected group, else puts it away.

        Args:
            state: what is shown.
            compared: the rates compared with; not of a group that the set is without.
            effects: of all rates, or of none as yet.
            mode: what the shown mode is called.
            is_old: whether the effects are those of rates that were.
        """
        is_selected = state.group == self._group.name
        assign(self._part, visible=is_selected)
        if not is_selected:
            return
        base = compared.get(self._group.name)
        old = " old" if is_old else ""
        listing = table(self._header(state, base, mode), self._rows(state, base, effects))
        assign(self._table, content=block(f'<div class="effects{old}">{listing}</div>'))
        loss = self._loss_factor(state)
        its_base = self._group.loss_factor_with(base or self._group.rates)
        assign(self._loss, label=row_label("loss factor", loss, its_base))
        mark(self._loss, its_base)

    def _header(self, state: State, base: MountRates | None, mode: str) -> Sequence[str]:
        reset = ""
        if base is not None and state.design.rates[self._group.name] != base:
            reset = self._signs.reset_group(state.against)
        felt = [f'<div title="{FELT}">{word} RMS</div>' for word in ("lat.", "vert.") if self._is_felt]
        moved = named(mode, f"Frequency of {mode}, by dampers its damping, percent of critical")
        return ("+10 %", moved, *felt, "", reset)

    def _rows(self, state: State, base: MountRates | None, effects: Effects) -> list[str]:
        fields, rows = self._group.fields, []
        for kind, its in sections(fields):
            rows += [row([span(kind, "dim")])] if kind else []
            rows += [self._row(fields.index(f), f, state, base, effects) for f in its]
        return rows

    def _row(self, i: int, field: str, state: State, base: MountRates | None, effects: Effects) -> str:
        key = self._group.name, field
        now = getattr(state.design.rates[self._group.name], field)
        is_changed = base is not None and now != getattr(base, field)
        shown = _cells(effects.get(key))[: 3 if self._is_felt else 1]
        lock = self._signs.lock(i, key in state.design.locked)
        reset = self._signs.reset(i, state.against) if is_changed else ""
        return row([direction(field), *shown, lock, reset])

    def _loss_factor(self, state: State) -> float:
        rates = state.design.rates.get(self._group.name, self._group.rates)
        return self._group.loss_factor_with(rates)

    def _is_linked(self, state: State) -> bool:
        return self._group.name in state.design.linked


def _cells(effect: Effect | None) -> tuple[str, str, str]:
    """Return the effects of a rate, good and bad where less is better; nothing until they are known."""
    if effect is None:
        return "", "", ""
    return (
        effect.of_mode,
        _judged(effect.lateral_percent),
        _judged(effect.vertical_percent),
    )


def _judged(percent: float | None) -> str:
    if percent is None:
        return span("–", "dim")
    kind = "dim" if abs(percent) < 0.05 else "good" if percent < 0 else "bad"
    return span(signed(percent, 1, " %"), kind)


def _linked_hint(group: MountGroup) -> str:
    """Return what becomes of the other rates of a group that keeps its ratios."""
    kinds = {is_damping(field) for field in group.fields}
    apart = ", dampers with dampers and springs with springs" if len(kinds) > 1 else ""
    return f"When one of these rates moves, the others move by the same factor{apart}"
