"""What a body is that was imported, in figures that an engineer can compare with what they know."""

from pathlib import Path

import numpy as np

from modeviz.errors import listed
from modeviz.formats.attachments import Found
from modeviz.units import factor
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.residual_estimate import estimate_residuals
from modeviz.vehicle.residuals import modal_compliance

ROUNDING = 1e-9
"""So small a part of the compliance of an attachment is none."""


def summary(body: FlexibleBody, attachments: tuple[Found, ...], folder: Path) -> str:
    """Return what an engineer can compare with what they know of a body that was written."""
    _, inertia = body.rigid_fit.mass_about_center_of_gravity
    elastic = body.natural_frequency_hz[body.n_rigid : body.n_normal][:5]
    n_elastic = body.n_normal - body.n_rigid
    residual = f", {body.n_residuals} residual vectors" if body.n_residuals else ""
    lines = [
        f"{folder}: body {body.name!r}, {body.n_rigid} rigid and {n_elastic} elastic modes{residual}",
        f"mass {body.mass:.5g} kg, centre of gravity {_places(body.center_of_gravity)} m, "
        f"moments of inertia {_listed(np.diag(inertia))} kg m²",
        f"first elastic modes {', '.join(f'{f:.4g}' for f in elastic) or 'none'} Hz",
    ]
    modal, missing = modal_compliance(body), estimate_residuals(body).compliance
    what = "its modes and residual vectors are" if body.n_residuals else "its modes are"
    for found, attachment, own, more in zip(attachments, body.attachments, modal, missing, strict=True):
        far = f", {1000 * found.distance:.3g} mm from where it was asked for" if found.distance else ""
        truer = f", and about {_stiffness(own + more)} with those left out" if more.any() else ""
        lines.append(
            f"attachment {found.name!r} at {_places(attachment.position)} m{far}; {what} "
            f"{_stiffness(own)} N/mm stiff there{truer}{_unmoved_words(own)}"
        )
    if not attachments:
        lines.append("no attachments, so nothing can hold on to it: import it with --attach")
    return "\n".join(lines)


def _stiffness(compliance: np.ndarray) -> str:
    """N/mm of what gives way so much, "rigid" where it does not."""
    values = [
        "rigid" if still else f"{1 / own / factor('N/mm', 'stiffness'):.4g}"
        for own, still in zip(compliance, _unmoved(compliance), strict=True)
    ]
    return f"[{', '.join(values)}]"


def _unmoved(compliance: np.ndarray) -> np.ndarray:
    """Along which directions no mode moves an attachment but by rounding."""
    return compliance <= ROUNDING * compliance.max()


def _unmoved_words(compliance: np.ndarray) -> str:
    along = [axis for axis, still in zip("xyz", _unmoved(compliance), strict=True) if still]
    return f"; no elastic mode moves it along {listed(along)}" if along else ""


def _places(metres: np.ndarray) -> str:
    """To a nanometre, so that rounding is no place."""
    return _listed(np.round(metres, 9) + 0.0)


def _listed(values: np.ndarray) -> str:
    return f"[{', '.join(f'{value:.4g}' for value in values)}]"
