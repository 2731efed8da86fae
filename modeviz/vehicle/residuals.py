"""What the modes that a body was given without would add to its flexibility, added as numbers."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Attachment, FlexibleBody

ABOVE = 30.0
"""How many times as high as its highest mode the residual coordinates of a body ring."""


def modal_compliance(body: FlexibleBody) -> Floats:
    """Return how far a unit force at each attachment moves it along itself, (n_attachments, 3), m/N.

    Σ φ²/ω² over all but the rigid modes: it deforms the free body while it accelerates as a rigid one.
    """
    phi = _translations(body)[:, :, body.n_rigid :]
    return np.sum(phi**2 / body.omega_n_squared[body.n_rigid :], axis=2)


def with_residual_compliance(body: FlexibleBody, compliance: Mapping[str, Floats]) -> FlexibleBody:
    """Return a body whose attachments give way by so much more under static forces.

    Each direction of an attachment gets a coordinate of its own, φ = ω √R there and zero elsewhere,
    with unit modal mass and ω `ABOVE` times the highest of the body: a static force moves it by
    φ²/ω² = R, exactly, and one at the frequency of the highest mode by 1/(1 - 1/ABOVE²) times that, a
    thousandth more. It is orthogonal to the modes in mass and stiffness by what it is: a spring of
    compliance R between the body and the point that is held, which has a mass of 1/φ².

    Args:
        body: with the attachments that are named.
        compliance: (3,) along x, y and z of attachments, m/N, zero or more.
    """
    top = ABOVE**2 * max(float(body.omega_n_squared.max(initial=0.0)), 1.0)
    wanted = [
        (name, axis, float(np.sqrt(top * value)))
        for name, values in compliance.items()
        for axis, value in enumerate(values)
        if value > 0
    ]
    n_more = len(wanted)

    def extended(attachment: Attachment) -> Attachment:
        more = np.zeros((6, n_more))
        for column, (name, axis, phi) in enumerate(wanted):
            more[axis, column] = phi * (name == attachment.name)
        return replace(attachment, shapes=np.hstack([attachment.shapes, more]))

    still = np.zeros((*body.shapes.shape[:2], n_more), body.shapes.dtype)
    return replace(
        body,
        omega_n_squared=np.r_[body.omega_n_squared, np.full(n_more, top)],
        n_residuals=body.n_residuals + n_more,
        attachments=tuple(extended(a) for a in body.attachments),
        shapes=np.concatenate([body.shapes, still], axis=2),
    )


def _translations(body: FlexibleBody) -> Floats:
    """(n_attachments, 3, n_modes)."""
    return np.array([a.shapes[:3] for a in body.attachments]).reshape(-1, 3, body.n_modes)
