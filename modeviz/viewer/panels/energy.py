"""Right column, lower part: where the shown mode has its energy, now and before."""

from collections.abc import Mapping
from html import escape

import viser

from modeviz.errors import cut
from modeviz.text.wording import sentence_case
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import (
    TWO_LINES,
    block,
    clamped,
    heading,
    hinted,
    legend,
    named,
    row,
    span,
    table,
    title,
)
from modeviz.viewer.page.widgets.named_buttons import NamedButtons
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import SelectGroup
from modeviz.viewer.session.session import Session

LEAST_SHOWN = 0.005
"""Shares below are not listed, but those of the mount groups are."""

MOVES_FREELY = (
    "Nothing is strained: this mode moves freely. Stiffen the mounts, or choose another mode."
)

Shares = Mapping[str, float]


class EnergyPanel:
    """Energy of the shown mode: kinetic by body, strain and loss by mount group and the rest."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Makes room; `show` fills it."""
        self._bodies: Mapping[str, str] = {}
        self._groups: Mapping[str, str] = {}
        self._session = session
        self._buttons = NamedButtons[str](gui, self._select)
        self._content = gui.add_html("")

    def show(self, solved: Solved) -> None:
        """Draws the shares of an answer's shown mode."""
        vehicle = solved.now.prepared.vehicle
        self._bodies = {body.name: body.label for body in vehicle.bodies}
        self._groups = {group.name: group.meaning for group in vehicle.mount_groups}
        self._buttons.keep(self._groups)
        before = solved.followed.same
        colors = legend((("--mv-base", escape(solved.state.against)), ("--mv-now", "now")))
        kinetic = {
            name: float(e[solved.followed.mode]) for name, e in solved.now.kinetic_energy.items()
        }
        content = block(
            heading(f"{title(solved.followed.name.spoken)}: kinetic energy", colors),
            self._kinetic(kinetic, _shares(solved.base.kinetic_energy, before)),
            heading("Strain energy", "click a mount group to see its rates" if self._groups else ""),
            self._strain(solved, _shares(solved.base.strain_energy, before)),
            *self._dissipated(solved, before),
        )
        assign(self._content, content=content)

    def _select(self, group: str) -> None:
        self._session.do(SelectGroup(group))

    def _kinetic(self, now: Shares, base: Shares | None) -> str:
        names = sorted(_worth_listing(now, base), key=lambda name: -now[name])
        largest = _largest(now, base)
        return table(
            (),
            [row(_cells(named(sentence_case(self._bodies[n])), n, now, base, largest)) for n in names],
            "energy",
        )

    def _strain(self, solved: Solved, base: Shares | None) -> str:
        """The mount groups in their order, then what else is strained."""
        now, largest = solved.strain, _largest(solved.strain, base)
        rows = [
            row(
                _cells(self._group(name), name, now, base, largest),
                chosen=name == solved.state.group,
            )
            for name in self._groups
        ]
        others = sorted(_worth_listing(now, base) - set(self._groups), key=lambda name: -now[name])
        rows += [row(_cells(self._other(n), n, now, base, largest)) for n in others]
        return table((), rows, "energy") if largest > 0 else span(MOVES_FREELY, "dim")

    def _dissipated(self, solved: Solved, before: int | None) -> list[str]:
        """What of the mode's loss in a cycle is where, the most first; nothing if it loses none."""
        now, base = solved.dissipated, _shares(solved.base.dissipated_energy, before)
        if not any(now.values()):
            return []
        names, largest = sorted(_worth_listing(now, base), key=lambda n: -now[n]), _largest(now, base)
        rows = [row(_cells(self._place(name), name, now, base, largest)) for name in names]
        told = hinted("Dissipated in a cycle", "By mounts, dampers and bending bodies")
        return [heading(told), table((), rows, "energy")]

    def _place(self, name: str) -> str:
        """Return the name of a mount group, or of what else loses energy."""
        return self._named(name) if name in self._groups else self._other(name)

    def _group(self, name: str) -> str:
        return self._buttons.label(name, self._named(name))

    def _named(self, name: str) -> str:
        """Return a mount group's name and what it means."""
        meaning = self._groups[name]
        content = f"{escape(cut(name, TWO_LINES))} {span(escape(meaning), 'dim')}"
        return clamped(content, f"{name} {meaning}".rstrip())

    def _other(self, name: str) -> str:
        """Return the name of what is strained but no mount group: a body that bends, or connections."""
        bends = f"{self._bodies[name]} itself" if name in self._bodies else name
        return span(named(sentence_case(bends)), "dim")


def _shares(energy: Mapping, mode: int | None) -> Shares | None:
    """The shares of one mode; None if there is no such mode."""
    return None if mode is None else {name: float(share[mode]) for name, share in energy.items()}


def _worth_listing(now: Shares, base: Shares | None) -> set[str]:
    return {
        n for n, share in now.items() if max(share, base.get(n, 0.0) if base else 0.0) > LEAST_SHOWN
    }


def _largest(now: Shares, base: Shares | None) -> float:
    return max([*now.values(), *(base or {}).values()], default=0.0)


def _cells(label: str, name: str, now: Shares, base: Shares | None, largest: float) -> list[str]:
    """A label, the share now above the one before as parts of the largest, and both in numbers."""
    before = base.get(name, 0.0) if base else 0.0
    bars = "".join(
        f'<div class="bar" style="height:{height}px;margin-top:1px">'
        f'<i style="width:{100 * share / (largest or 1.0):.1f}%;background:var({color})"></i></div>'
        for share, height, color in ((now[name], 6, "--mv-now"), (before, 3, "--mv-base"))
    )
    return [label, bars, _percent(now[name]), span(_percent(before) if base else "–", "dim")]


def _percent(share: float) -> str:
    return f"{100 * share:.0f} %"
