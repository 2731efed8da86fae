"""Modes of components whose files have mass and stiffness: computed here, with residual vectors."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.fem.free import ModalBasis, free_modes, free_modes_up_to
from modeviz.fem.matrices import Matrices
from modeviz.fem.residuals import dynamic_residual_vectors
from modeviz.formats.attachments import Found
from modeviz.formats.component import Component, Modes
from modeviz.formats.limits import check_shapes
from modeviz.vehicle.arrays import Floats

USUAL_MODES = 50

MOST_MODES = 1000


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """Which modes are computed of matrices."""

    n_modes: int = USUAL_MODES
    """The six rigid ones included; of smaller matrices, as many as they have."""
    up_to_hz: float | None = None
    """Instead, all up to this frequency, and the next."""

    def __post_init__(self) -> None:
        if not 7 <= self.n_modes <= MOST_MODES:
            raise VehicleError(
                f"modes: found {self.n_modes}, expected 7, the first elastic one, to {MOST_MODES}"
            )
        if self.up_to_hz is not None and not 0 < self.up_to_hz < np.inf:
            raise VehicleError(f"highest frequency: found {self.up_to_hz:g} Hz, expected more than 0")


def solved(
    component: Component,
    wanted: Wanted,
    attachments: Sequence[Found] = (),
    length: float = 1.0,
) -> Component:
    """Return a component with the modes of its matrices; one without matrices is as it was.

    Each direction of an attachment gets residual vectors, so that loads there deflect the body as they
    do the whole model.

    Args:
        component: with or without matrices.
        wanted: the modes.
        attachments: where others hold on to it.
        length: m of one of the component's units, in which attachments are.

    Raises:
        VehicleError: the matrices are not those of a free structure in one piece with these nodes.
    """
    if component.matrices is None:
        return component
    matrices = component.matrices
    with located(component.source):
        check_shapes(len(component.node_ids), wanted.n_modes + 6 * len(attachments))
        modes = _free_modes(matrices, wanted)
        loads = _loads(component, attachments, length)
        residuals = dynamic_residual_vectors(matrices, modes, matrices.motion.T @ loads)
    n_modes, n_residuals = (len(basis.omega_n_squared) for basis in (modes, residuals))
    frequency_hz = np.sqrt(np.r_[modes.omega_n_squared, residuals.omega_n_squared]) / (2 * np.pi)
    shapes = np.asarray(matrices.motion @ np.hstack([modes.shapes, residuals.shapes]))
    unknown = np.full(n_modes + n_residuals, np.nan)
    return replace(
        component,
        modes=Modes(
            frequency_hz,
            np.ones(n_modes + n_residuals),
            unknown,
            shapes.reshape(len(component.node_ids), 6, -1),
            n_residuals,
        ),
    )


def _free_modes(matrices: Matrices, wanted: Wanted) -> ModalBasis:
    if wanted.up_to_hz is not None:
        return free_modes_up_to(matrices, wanted.up_to_hz, MOST_MODES)
    return free_modes(matrices, min(wanted.n_modes, matrices.n_dofs - 1))


def _loads(component: Component, attachments: Sequence[Found], length: float) -> Floats:
    """Unit forces and moments at the attachments, (6 n_nodes, n_loads)."""
    loads = np.zeros((6 * len(component.node_ids), 6 * len(attachments)))
    for i, found in enumerate(attachments):
        dofs = (6 * found.rows[:, None] + np.arange(6)).ravel()
        np.add.at(loads[:, 6 * i : 6 * i + 6], dofs, found.motion.T)
    loads.reshape(len(component.node_ids), 6, 6 * len(attachments))[:, :3] *= length
    return loads
