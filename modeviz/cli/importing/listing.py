"""What files have of a component, for who looks before it is imported."""

import numpy as np

from modeviz.formats.body import uncoupled_because
from modeviz.formats.component import Component
from modeviz.report.tables import table

UNKNOWN = "unknown"


def listing(component: Component) -> str:
    """Return the modes of a component as a table, and what it is made of."""
    counts = [
        f"{len(corners)} {kind}{'s' if len(corners) != 1 else ''}"
        for kind, corners in component.elements.items()
    ]
    known = component.units.name if component.units else UNKNOWN
    reason = uncoupled_because(component)
    lines = [
        f"{component.source}: {len(component.node_ids)} nodes, {', '.join(counts) or 'no elements'}; "
        f"units {known}",
        f"It cannot be coupled to others: {reason}." if reason else "It can be coupled to others.",
    ]
    if not component.n_modes:
        return "\n".join(lines)
    modes = component.modes
    first_residual = component.n_modes - modes.n_residuals
    rows = [
        [
            f"{number + 1}" if number < first_residual else f"{number + 1}, residual vector",
            f"{frequency:.5g}",
            _known(mass, "{:.5g}"),
            _known(100 * ratio, "{:.2f}"),
        ]
        for number, (frequency, mass, ratio) in enumerate(
            zip(modes.frequency_hz, modes.modal_mass, modes.damping_ratio, strict=True)
        )
    ]
    return "\n".join([*lines, "", table(["mode", "Hz", "modal mass", "damping %"], rows)])


def _known(value: float, form: str) -> str:
    return form.format(value) if np.isfinite(value) else UNKNOWN
