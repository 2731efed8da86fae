"""Modes of components whose files have mass and stiffness: computed here, with residual vectors."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from modeviz.errors import VehicleError, located, unknown
from modeviz.fem.free import ModalBasis, free_modes, free_modes_up_to
from modeviz.fem.matrices import Matrices
from modeviz.fem.reduction import craig_bampton_reduction, guyan_reduction, retained_up_to
from modeviz.fem.residuals import dynamic_residual_vectors
from modeviz.files.limits import check_size
from modeviz.formats.attachments import Found
from modeviz.formats.component import Component, Modes
from modeviz.formats.limits import MOST_NUMBERS, check_shapes
from modeviz.vehicle.arrays import Floats

Condensation = Literal["guyan", "craig-bampton"]

NAMES: Mapping[Condensation, str] = {"guyan": "Guyan", "craig-bampton": "Craig and Bampton"}

MARGIN = 3.0
"""Condensed bodies keep what vibrates below so many times the highest wanted frequency."""

USUAL_MODES = 50

MOST_MODES = 1000


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """Which modes are computed of matrices; nothing said, the lowest `USUAL_MODES`."""

    n_modes: int | None = None
    """The six rigid ones included; of smaller matrices, as many as they have."""
    up_to_hz: float | None = None
    """Instead, all up to this frequency, and the next."""
    condensed: Condensation | None = None
    """How the matrices are condensed first; needs the frequency."""

    def __post_init__(self) -> None:
        if self.n_modes is not None and self.up_to_hz is not None:
            raise VehicleError("--modes and --up-to: found both, expected one of them")
        if self.n_modes is not None and not 7 <= self.n_modes <= MOST_MODES:
            raise VehicleError(
                f"--modes: found {self.n_modes}, expected 7, the first elastic one, to {MOST_MODES}"
            )
        if self.up_to_hz is not None and not 0 < self.up_to_hz < np.inf:
            raise VehicleError(f"--up-to: found {self.up_to_hz:g} Hz, expected more than 0")
        if self.condensed is not None and self.condensed not in get_args(Condensation):
            raise VehicleError(f"--condense: {unknown('way', self.condensed, get_args(Condensation))}")
        if self.condensed is not None and self.up_to_hz is None:
            raise VehicleError(
                f"--condense: found {self.condensed}, and nothing says up to which frequency the rest "
                "is needed (--up-to)"
            )

    @property
    def options(self) -> tuple[str, ...]:
        """What is said of them, as the command calls it."""
        said = {"--modes": self.n_modes, "--up-to": self.up_to_hz, "--condense": self.condensed}
        return tuple(option for option, value in said.items() if value is not None)

    @property
    def most(self) -> int:
        """How many are computed at most."""
        return USUAL_MODES if self.n_modes is None else self.n_modes


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
        VehicleError: the matrices are not those of a free structure in one piece with these nodes, or
            there are none of which what is wanted could be computed.
    """
    if component.matrices is None:
        if wanted.options:
            raise VehicleError(
                f"{wanted.options[0]}: is of mass and stiffness matrices, of which modes are computed, "
                f"and {component.source} has none"
            )
        return component
    matrices = component.matrices
    with located(component.source):
        check_shapes(len(component.node_ids), wanted.most + 6 * len(attachments))
        loads = _loads(component, attachments, length)
        matrices, said = _condensed(matrices, wanted, loads)
        modes = _free_modes(matrices, wanted)
        residuals = dynamic_residual_vectors(matrices, modes, matrices.motion.T @ loads)
    n_modes, n_residuals = (len(basis.omega_n_squared) for basis in (modes, residuals))
    frequency_hz = np.sqrt(np.r_[modes.omega_n_squared, residuals.omega_n_squared]) / (2 * np.pi)
    shapes = np.asarray(matrices.motion @ np.hstack([modes.shapes, residuals.shapes]))
    unknown = np.full(n_modes + n_residuals, np.nan)
    return replace(
        component,
        notes=(*component.notes, *said),
        modes=Modes(
            frequency_hz,
            np.ones(n_modes + n_residuals),
            unknown,
            shapes.reshape(len(component.node_ids), 6, -1),
            n_residuals,
        ),
    )


def _condensed(matrices: Matrices, wanted: Wanted, loads: Floats) -> tuple[Matrices, tuple[str, ...]]:
    """The matrices in fewer degrees of freedom, if that is wanted, and a sentence on that.

    Those that move loaded nodes are kept.
    """
    if wanted.condensed is None or wanted.up_to_hz is None:
        return matrices, ()
    highest = MARGIN * wanted.up_to_hz
    held = np.flatnonzero(abs(matrices.motion.T) @ (loads != 0).any(axis=1))
    if wanted.condensed == "guyan":
        retained = retained_up_to(matrices, highest, held)
        _check_room(matrices, len(retained))
        condensed = guyan_reduction(matrices, retained).matrices
    else:
        _check_room(matrices, len(held))
        condensed = craig_bampton_reduction(matrices, held, highest)
    said = (
        f"condensed from {matrices.n_dofs} to {condensed.n_dofs} degrees of freedom, {len(held)} of "
        f"them at attachments, by {NAMES[wanted.condensed]}, with what vibrates up to {highest:g} Hz"
    )
    return condensed, (said,)


def _check_room(matrices: Matrices, n_retained: int) -> None:
    check_size(f"numbers in {n_retained} static modes", matrices.n_dofs * n_retained, MOST_NUMBERS)


def _free_modes(matrices: Matrices, wanted: Wanted) -> ModalBasis:
    if wanted.up_to_hz is not None:
        return free_modes_up_to(matrices, wanted.up_to_hz, MOST_MODES)
    return free_modes(matrices, min(wanted.most, matrices.n_dofs - 1))


def _loads(component: Component, attachments: Sequence[Found], length: float) -> Floats:
    """Unit forces and moments at the attachments, (6 n_nodes, n_loads)."""
    loads = np.zeros((6 * len(component.node_ids), 6 * len(attachments)))
    for i, found in enumerate(attachments):
        dofs = (6 * found.rows[:, None] + np.arange(6)).ravel()
        np.add.at(loads[:, 6 * i : 6 * i + 6], dofs, found.motion.T)
    loads.reshape(len(component.node_ids), 6, 6 * len(attachments))[:, :3] *= length
    return loads
