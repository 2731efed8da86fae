"""What the modes that a body was given without would add to its flexibility: estimated, and added."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Attachment, FlexibleBody

ABOVE = 30.0
"""How many times as high as its highest mode the residual coordinates of a body ring."""

COVERED = 0.02
"""Residual vectors that add this part of what is estimated, which may be many times too much, are taken
to add all there is: by so little do those of other directions move a place."""

FEW = 12
"""Of fewer elastic modes an estimate is no more than an order of magnitude."""


def modal_compliance(body: FlexibleBody) -> Floats:
    """Return how far a unit force at each attachment moves it along itself, (n_attachments, 3), m/N.

    Σ φ²/ω² over all but the rigid modes: it deforms the free body while it accelerates as a rigid one.
    """
    phi = _translations(body)[:, :, body.n_rigid :]
    return np.sum(phi**2 / body.omega_n_squared[body.n_rigid :], axis=2)


def estimated_residual_compliance(body: FlexibleBody) -> Floats:
    """Return an estimate of what modes left out would add to that, (n_attachments, 3), m/N.

    Σ φ² / ω_c² over the elastic normal modes, with ω_c the end of the band that they fill: above it
    modes are taken to lie as densely as below and to move each attachment as much, so that
    ∫ (Σ φ²/ω_c) ω⁻² dω from ω_c on is left (E. Skudrzyk, "The mean-value method of predicting the
    dynamic response of complex vibrators", 1980; sheets have a constant density of modes in bending).
    Of bodies of sheet metal with `FEW` modes or more, across their sheets, it is mostly within a factor
    of two. It may be several times off in the plane of sheets, in solids, and where symmetry lets few
    modes move an attachment. Zero in directions in which residual vectors of the body act.
    """
    elastic = slice(body.n_rigid, body.n_normal)
    n_elastic = body.n_normal - body.n_rigid
    if not n_elastic:
        return np.zeros((len(body.attachments), 3))
    end = body.omega_n_squared[body.n_normal - 1] * (1 + 0.5 / n_elastic) ** 2
    phi = _translations(body)
    estimate = np.sum(phi[:, :, elastic] ** 2, axis=2) / end
    residual = np.sum(phi[:, :, body.n_normal :] ** 2 / body.omega_n_squared[body.n_normal :], axis=2)
    return np.where(residual >= COVERED * estimate, 0.0, estimate)


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


def as_estimated(body: FlexibleBody) -> FlexibleBody:
    """Return a body with the residual compliance that is estimated of it."""
    estimate = estimated_residual_compliance(body)
    names = [a.name for a in body.attachments]
    return with_residual_compliance(body, dict(zip(names, estimate, strict=True)))


def _translations(body: FlexibleBody) -> Floats:
    """(n_attachments, 3, n_modes)."""
    return np.array([a.shapes[:3] for a in body.attachments]).reshape(-1, 3, body.n_modes)
