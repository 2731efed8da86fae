"""Right column, lower part: the modes and where the shown one has its energy."""

from collections.abc import Mapping, Sequence
from html import escape

import numpy as np
import viser

from modeviz.dynamics.naming import ModeName
from modeviz.export.wording import sentence_case, signed
from modeviz.tuning.results import Results
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.answers import FREE_HZ, Solved
from modeviz.viewer.assign import assign
from modeviz.viewer.html import (
    HiddenButtons,
    block,
    heading,
    row,
    span,
    table,
    title,
)
from modeviz.viewer.ladder import Rail, drawn, ladder
from modeviz.viewer.session import Session

LISTED_HZ = (FREE_HZ, 21.0)
"""Above, the ride ends."""

SAME_SHAPE = 0.8
"""A shape of which a mode holds this much needs no further word."""

N_PARTS, LEAST_PART = 3, 0.05
"""How many modes that hold a part of a shape are named, and how large a part must be."""

N_ROWS = 40
BODY_COLORS = ("#c4704e", "#4a749e", "#5c8668", "#9499a0", "#5d656f", "#b59a5a", "#7d6b8f", "#8a8378")


class ModesPanel:
    """The ladder of frequencies and a table whose rows show their mode when clicked."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the table; `show` fills it."""
        self._names: list[str] = []
        self._labels = {body.name: body.label for body in session.vehicle.bodies}
        self._buttons = HiddenButtons(gui, N_ROWS, lambda i: self._select(session, i))
        self._content = gui.add_html("")

    def _select(self, session: Session, i: int) -> None:
        names = self._names
        if i < len(names):  # else a shorter list came between the click and here
            session.show_mode(names[i])

    def show(self, solved: Solved) -> None:
        """Lists the modes of an answer."""
        now, modes = solved.now, listed(solved.now)
        before = {name.name: f for name, f in listed(solved.base).values()}
        after = {name.name: f for name, f in modes.values()}
        self._names = list(after)[:N_ROWS]
        moved = _moves_most(now, self._labels)
        rows = [
            row(self._cells(i, mode, now, before, moved[mode]), chosen=mode == solved.mode)
            for i, mode in enumerate(list(modes)[:N_ROWS])
        ]
        listing = table(("Mode", "Hz", "Δ Hz", "ζ %", "moves most"), rows)
        assign(self._content, content=block(_ladder(solved), _old_shape(solved), listing))

    def _cells(
        self, i: int, mode: int, now: Results, before: dict[str, float], moved: str
    ) -> list[str]:
        name, f = now.names[mode].name, float(now.modes.frequency_hz[mode])
        change = f - before[name] if name in before else None
        return [
            self._buttons.label(i, title(now.names[mode].spoken)),
            f"{f:.2f}",
            span("new" if change is None else signed(change, 2), "dim" if not change else ""),
            f"{100 * now.modes.damping_ratio[mode]:.1f}",
            span(moved, "dim"),
        ]


class EnergyPanel:
    """Kinetic energy of the shown mode by body, strain energy by mount group."""

    def __init__(self, gui: viser.GuiApi, vehicle: Vehicle) -> None:
        """Makes room; `show` fills it."""
        self._labels = {body.name: body.label for body in vehicle.bodies}
        self._groups = [group.name for group in vehicle.mount_groups]
        self._content = gui.add_html("")

    def show(self, solved: Solved) -> None:
        """Draws the shares of an answer's shown mode."""
        name = title(solved.name.spoken)
        content = block(
            heading(f"{name}: kinetic energy by body"),
            _kinetic(solved.now, solved.mode, self._labels),
            heading("Strain energy by mount group"),
            _strain(solved, self._groups),
        )
        assign(self._content, content=content)


def _ladder(solved: Solved) -> str:
    """The ladder of all modes, joined where the shapes of the original's modes went."""
    base, now, track = solved.base, solved.now, solved.track
    old = base.mode_index(solved.name.name)
    before, after = base.modes.frequency_hz.tolist(), track.frequency_hz.tolist()
    weak = track.weak.tolist()
    rails = [
        Rail(before[i], after[i], weak[i], strong=i == old)
        for i in range(len(before))
        if track.index[i] >= 0 and (drawn(before[i]) or drawn(after[i]))
    ]
    f = now.modes.frequency_hz[solved.mode]
    was = "" if old is None else f" {base.modes.frequency_hz[old]:.2f} →"
    return ladder(
        before,
        now.modes.frequency_hz.tolist(),
        rails,
        solved.mode,
        f"{sentence_case(solved.name.spoken)}{was} {f:.2f}",
    )


def _old_shape(solved: Solved) -> str:
    """What became of the shape that had the shown mode's name, where it is no longer that mode."""
    name = solved.name.name
    old = solved.base.mode_index(name)
    if old is None or solved.track.shares[old, solved.mode] > SAME_SHAPE:
        return ""
    modes, names = solved.now.modes, solved.now.names
    parts = [
        f"{100 * share:.0f} % {escape(names[i].spoken)} {modes.frequency_hz[i]:.2f} Hz"
        for i, share in solved.track.split(old, N_PARTS)
        if share > LEAST_PART
    ]
    return f'<div class="dim">The original\'s {escape(name)} is now {", ".join(parts)}</div>'


def listed(results: Results) -> dict[int, tuple[ModeName, float]]:
    """The modes of the ride band by index: name and frequency."""
    return {
        i: (results.names[i], f)
        for i, f in enumerate(results.modes.frequency_hz.tolist())
        if LISTED_HZ[0] < f < LISTED_HZ[1]
    }


def _moves_most(results: Results, labels: Mapping[str, str]) -> list[str]:
    """For every mode the body with the largest share of its kinetic energy, and that share."""
    bodies = [escape(labels[name]) for name in results.kinetic_energy]
    shares = np.stack(list(results.kinetic_energy.values()))
    most = shares.argmax(axis=0).tolist()
    percent = (100 * shares.max(axis=0)).tolist()
    return [f"{bodies[i]} {share:.0f} %" for i, share in zip(most, percent, strict=True)]


def _kinetic(results: Results, mode: int, labels: Mapping[str, str]) -> str:
    """One bar in the colours of the bodies, and its legend."""
    shares = sorted(((e[mode], body) for body, e in results.kinetic_energy.items()), reverse=True)
    shown = [
        (share, labels[body], BODY_COLORS[i])
        for i, (share, body) in enumerate(shares[: len(BODY_COLORS)])
        if share > 0.01
    ]
    bars = "".join(
        f'<i style="width:{100 * share:.1f}%;background:{color}" '
        f'title="{escape(label)} {100 * share:.0f} %"></i>'
        for share, label, color in shown
    )
    legend = " &nbsp; ".join(
        f'<span style="white-space:nowrap"><i class="swatch" style="background:{color}"></i>'
        f"{title(label)} {100 * share:.0f} %</span>"
        for share, label, color in shown
    )
    return (
        f'<div class="bar" style="height:11px">{bars}</div>'
        f'<div style="font-size:11px;margin:4px 0 8px">{legend}</div>'
    )


def _strain(solved: Solved, groups: Sequence[str]) -> str:
    """A table of the mount groups: their share now and with the original rates."""
    name = solved.name.name
    before = solved.base.mode_index(name)
    now = {g: solved.strain[g] for g in groups}
    base = {g: solved.base.strain_energy[g][before] if before is not None else 0.0 for g in groups}
    largest = max([*now.values(), *base.values(), 1e-9])
    rows = [
        row(
            [
                escape(g),
                _bars(now[g] / largest, base[g] / largest),
                _percent(now[g]),
                span(_percent(base[g]), "dim"),
            ],
            chosen=g == solved.state.group,
        )
        for g in groups
    ]
    return table(("", "", "now", "original"), rows)


def _bars(now: float, base: float) -> str:
    """The share now above the one before, as parts of the largest."""
    return "".join(
        f'<div class="bar" style="height:{height}px;margin-top:1px">'
        f'<i style="width:{100 * share:.1f}%;background:var({color})"></i></div>'
        for share, height, color in ((now, 6, "--mv-now"), (base, 3, "--mv-base"))
    )


def _percent(share: float) -> str:
    return f"{100 * share:.0f} %"
