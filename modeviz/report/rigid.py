"""Rigid bodies on their mounts as text tables and as plain values."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict

import numpy as np

from modeviz.analysis.modal_results import ModalResults
from modeviz.analysis.rigid import BodyAxes, RigidBodyFigures
from modeviz.mounting.axes import ElasticAxes
from modeviz.mounting.focus import Focus
from modeviz.mounting.purity import Gap, Purity
from modeviz.report.records import Record, rates_record
from modeviz.report.tables import own_frequencies, table
from modeviz.text.wording import sentence_case
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.decoupling import Axes, Decoupling

LISTED = 0.02
"""A mode in which a body has less than this part of the kinetic energy is not listed with it."""

HELD, MOUNTED = "other ends of its mounts held still", "on all that is elastic, down to the ground"
"""How a body is held when its axes are told."""


def rigid_table(results: ModalResults, bodies: Sequence[RigidBodyFigures], axes: Axes) -> str:
    """Return energy in six directions by mode, what is asked of it, and axes and centres."""
    tables = "\n\n\n".join(_body_table(results, figures, axes) for figures in bodies)
    notes = [
        f"{sentence_case(words)}, axes and centres those at these frequencies."
        for words in own_frequencies(results.vehicle)
    ]
    return "\n\n".join([tables, *notes])


def _body_table(results: ModalResults, figures: RigidBodyFigures, axes: Axes) -> str:
    along = "crank axes" if figures.axes.has_crank else "axes along the torque"
    of_axes = {"vehicle": "vehicle axes", "principal": "principal axes", "crank": along}[axes]
    header = [f"{figures.name}, % of the mode, {of_axes}", "Hz", *MOTIONS, "share", "purity", ""]
    rows = [_mode_cells(results, figures.purity, mode) for mode in listed_modes(figures.purity)]
    parts = [table(header, rows), "\n".join(verdict_lines(figures.purity)), axes_table(figures.axes)]
    return "\n\n".join(parts)


def _mode_cells(results: ModalResults, found: Purity, mode: int) -> list[str]:
    motion = found.motion_of(mode)
    own = "" if motion is None else f"{motion} {percent(found.purity(motion) or 0.0)}"
    return [
        f"{mode + 1:3d}  {results.names[mode].spoken}",
        f"{found.frequency_hz[mode]:.2f}",
        *(percent(e) for e in found.energy[mode]),
        percent(found.share[mode]),
        own,
        "" if motion is None else passed(found.is_pure(motion) and found.is_in_band(motion)),
    ]


def listed_modes(found: Purity) -> list[int]:
    """Return the modes in which a body takes part, and its own."""
    own = {mode for mode in found.modes if mode is not None}
    return sorted(own | set(np.flatnonzero(found.share > LISTED).tolist()))


def verdict_lines(found: Purity) -> Iterator[str]:
    """Yield a line on each thing that is asked of a body's modes, as far as it has any."""
    targets, pure = found.targets, [m for m in MOTIONS if found.is_pure(m)]
    missing = [m for m in MOTIONS if found.frequency(m) is None]
    if missing:
        yield f"  no mode of its own in the band: {', '.join(missing)}"
    if len(missing) == len(MOTIONS):
        return
    mixed = [_mixed(found, m) for m in MOTIONS if m not in (*pure, *missing)]
    yield _line(f"purity {percent(targets.purity)} %", mixed)
    outside = [
        f"{m} at {found.frequency(m):.2f} Hz"
        for m in MOTIONS
        if m not in missing and not found.is_in_band(m)
    ]
    yield _line(f"{targets.lowest_frequency:g} to {targets.highest_frequency:g} Hz", outside)
    for what, gaps, wanted in (
        ("gap", found.gaps, targets.gap),
        (f"bounce to {found.crank_word} gap", found.bounce_gaps, targets.bounce_gap),
    ):
        close = [gap_words(gap) for gap in gaps if not gap.passes]
        yield _line(f"{what} {wanted:g} Hz", close)


def _mixed(found: Purity, motion: str) -> str:
    return f"{motion} {percent(found.purity(motion) or 0.0)} %"


def gap_words(gap: Gap) -> str:
    """Return two motions and how far apart their modes are: "x and z 1.20 Hz"."""
    return f"{gap.motions[0]} and {gap.motions[1]} {gap.hz:.2f} Hz"


def _line(what: str, failing: Sequence[str]) -> str:
    return f"  {what}: {passed(not failing)}" + (f" ({', '.join(failing)})" if failing else "")


def passed(passes: bool) -> str:
    """Return "pass" or "fail"."""
    return "pass" if passes else "fail"


def percent(part: float) -> str:
    """Return a part in percent, to one decimal."""
    return f"{round(100 * part, 1) + 0.0:.1f}"


def axes_table(axes: BodyAxes) -> str:
    """Return axes and centres, with the ways it is held one beside the other."""
    rows = [[torque_word(axes), vector(axes.crank), ""]]
    roll = axes.torque_roll_axis
    rows.append(["torque roll axis, free", vector(roll and roll.direction), ""])
    held, mounted = axis_rows(axes.held), axis_rows(axes.mounted)
    rows += [[name, held[name], mounted[name]] for name in held]
    if axes.focus is not None:
        rows.append([f"focus of {', '.join(axes.focus.mounts)}, m", focus_words(axes.focus), ""])
    header = ["axes and centres", HELD, MOUNTED]
    return table(header, rows)


def torque_word(axes: BodyAxes) -> str:
    """Return what the direction of the torque is called for which axes are told."""
    return "crank" if axes.has_crank else "torque about"


def axis_rows(axes: ElasticAxes | None, decimals: int = 4) -> dict[str, str]:
    """Return the numbers of one way in which a body is held, by what they are.

    Args:
        axes: those of the body; None if it moves freely.
        decimals: of places and directions.
    """
    rows = {
        "elastic torque axis": "-",
        "  through, m": "-",
        "  off the roll axis, °": "-",
        "  apart from it, mm": "-",
        "elastic centre, m": "-",
        **{f"elastic axis {n}, N/mm": "-" for n in "123"},
    }
    if axes is None:
        return dict.fromkeys(rows, "moves freely")
    per_mm, axis = factor("N/mm", "stiffness"), axes.torque_axis
    if axis is not None:
        angle, offset = f"{np.degrees(axes.angle):.3f}", f"{1e3 * axes.offset:.1f}"
        values = vector(axis.direction, decimals), vector(axis.point, decimals), angle, offset
        rows |= dict(zip(list(rows)[:4], values, strict=True))
    if axes.center is not None:
        rows["elastic centre, m"] = vector(axes.center, decimals)
    for n, rate, direction in zip("123", axes.rates, axes.principal_axes, strict=True):
        rows[f"elastic axis {n}, N/mm"] = f"{vector(direction, decimals)}: {rate / per_mm:.4g}"
    return rows


def focus_words(focus: Focus) -> str:
    """Return a focus and how far the axes of its mounts pass it."""
    return f"{vector(focus.point)}, missed by {1e3 * focus.miss:.1f} mm"


def vector(values: Floats | None, decimals: int = 4) -> str:
    """Return three numbers; a dash for none."""
    if values is None:
        return "-"
    return " ".join(f"{v + 0.0:.{decimals}f}" for v in np.round(values, decimals))


def rigid_record(results: ModalResults, bodies: Sequence[RigidBodyFigures], axes: Axes) -> Record:
    """Return rigid bodies on their mounts.

    `{"vehicle", "rates": see rates_record, "axes", "targets": the fields of
    vehicle.decoupling.Decoupling, "frequency_hz": [each mode], "modes": [names], "bodies": {name: see
    below}}`; parts are from 0 to 1, places in m, rates in N/mm.

    `{"energy": [[x, y, z, rx, ry, rz] for each mode], "share": [...], "frame": [three rows],
    "center_of_gravity", "own_modes": {motion: number or null}, "purity": {motion: part or null},
    "passes", "gaps": [{"motions", "hz", "wanted_hz", "passes"}], "crank_axis", "torque_roll_axis",
    "elastic_torque_axis", "angle_deg", "elastic_center", "held", "mounted", "focus": {"mounts",
    "point", "miss"} or null}`; of the axes those without "mounted" are with the other ends held still.

    `{"elastic_torque_axis", "through", "pitch": m/rad, "angle_deg", "offset", "elastic_center",
    "principal_axes": [three rows], "rates": N/mm, "lines": [a point or null for each], "spread"}`.
    """
    return {
        "vehicle": results.vehicle.name,
        "rates": rates_record(results.vehicle),
        "axes": axes,
        "targets": asdict(bodies[0].purity.targets) if bodies else asdict(Decoupling()),
        "frequency_hz": results.modes.frequency_hz.tolist(),
        "modes": [name.name for name in results.names],
        "bodies": {figures.name: _body_record(figures) for figures in bodies},
    }


def _body_record(figures: RigidBodyFigures) -> Record:
    found, axes = figures.purity, figures.axes
    held = _axes_record(axes.held)
    roll, aim = axes.torque_roll_axis, axes.focus
    kept = ("elastic_torque_axis", "angle_deg", "elastic_center")
    return {
        "energy": found.energy.tolist(),
        "share": found.share.tolist(),
        "frame": figures.frame.tolist(),
        "center_of_gravity": figures.part.center.tolist(),
        "own_modes": {
            m: None if mode is None else mode + 1 for m, mode in zip(MOTIONS, found.modes, strict=True)
        },
        "purity": {m: found.purity(m) for m in MOTIONS},
        "passes": found.passes,
        "gaps": [
            {"motions": list(g.motions), "hz": g.hz, "wanted_hz": g.wanted, "passes": g.passes}
            for g in (*found.gaps, *found.bounce_gaps)
        ],
        "crank_axis": axes.crank.tolist(),
        "torque_roll_axis": None if roll is None else roll.direction.tolist(),
        **{key: None if held is None else held[key] for key in kept},
        "held": held,
        "mounted": _axes_record(axes.mounted),
        "focus": aim and {"mounts": list(aim.mounts), "point": aim.point.tolist(), "miss": aim.miss},
    }


def _axes_record(axes: ElasticAxes | None) -> Record | None:
    if axes is None:
        return None
    axis, has_angle = axes.torque_axis, np.isfinite(axes.angle)
    return {
        "elastic_torque_axis": None if axis is None else axis.direction.tolist(),
        "through": None if axis is None else axis.point.tolist(),
        "pitch": axes.pitch,
        "angle_deg": float(np.degrees(axes.angle)) if has_angle else None,
        "offset": axes.offset if has_angle else None,
        "elastic_center": None if axes.center is None else axes.center.tolist(),
        "principal_axes": axes.principal_axes.tolist(),
        "rates": (axes.rates / factor("N/mm", "stiffness")).tolist(),
        "lines": [None if line is None else line.point.tolist() for line in axes.lines],
        "spread": axes.spread,
    }
