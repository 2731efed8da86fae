"""Components of a vehicle made of meshes or matrices: free modes, residual vectors, attachments."""

from collections.abc import Sequence

import numpy as np

from modeviz.fem.attachments import AttachmentPoint, unit_loads
from modeviz.fem.free import free_modes
from modeviz.fem.matrices import Matrices, assemble
from modeviz.fem.mesh import FiniteElementMesh
from modeviz.fem.residuals import residual_vectors
from modeviz.vehicle.bodies import Attachment, FlexibleBody, Mesh, Role


def flexible_body(
    name: str,
    role: Role,
    label: str,
    mesh: FiniteElementMesh,
    attachments: Sequence[AttachmentPoint],
    n_modes: int,
    damping_ratio: float,
    display: Mesh = (),
    stiffness_factor: float = 1.0,
    mass_factor: float = 1.0,
) -> FlexibleBody:
    """A free component in its lowest modes and a residual vector for each direction of attachment.

    With residual vectors at everything that pulls on it the truck's modes below 20 Hz are within
    0.005 % of the full finite-element model; with as many modes alone, within 4 %.

    Args:
        name: of the body.
        role: what it is in the vehicle.
        label: what a person calls it.
        mesh: the whole free body, in one piece.
        attachments: where things hang; each of their directions gets a residual vector.
        n_modes: how many free modes to keep, the six rigid ones included.
        damping_ratio: viscous, of every mode.
        display: what is drawn.
        stiffness_factor: multiplies the stiffness of the whole.
        mass_factor: multiplies the mass of the whole.

    Raises:
        ModevizError: pyfe3d is not installed.
        SolveError: the mesh is not in one piece or too small for so many modes.
        VehicleError: an attachment cannot hang where it says.
    """
    matrices = assemble(mesh).scaled(stiffness_factor, mass_factor)
    return body_from_matrices(name, role, label, matrices, attachments, n_modes, damping_ratio, display)


def body_from_matrices(
    name: str,
    role: Role,
    label: str,
    matrices: Matrices,
    attachments: Sequence[AttachmentPoint],
    n_modes: int,
    damping_ratio: float,
    display: Mesh = (),
) -> FlexibleBody:
    """A free component of given mass and stiffness, as `flexible_body` makes it of a mesh.

    A large model may be condensed first, as A. E. Duncan does: `reduction.guyan_reduction`, whose
    `matrices` are given here. Balanced forces then deflect attachments as they do the whole model,
    where all their nodes are retained.

    Args:
        name: of the body.
        role: what it is in the vehicle.
        label: what a person calls it.
        matrices: of the whole free body, in one piece.
        attachments: where things hang; each of their directions gets a residual vector.
        n_modes: how many free modes to keep, the six rigid ones included.
        damping_ratio: viscous, of every mode.
        display: what is drawn.

    Raises:
        SolveError: the body is not in one piece or too small for so many modes.
        VehicleError: an attachment cannot hang where it says.
    """
    nodes = matrices.nodes
    modes = free_modes(matrices, n_modes)
    residuals = residual_vectors(matrices, modes, matrices.motion.T @ unit_loads(attachments, nodes))
    shapes = matrices.motion @ np.hstack([modes.shapes, residuals.shapes])
    return FlexibleBody(
        name=name,
        role=role,
        label=label,
        omega_n_squared=np.r_[modes.omega_n_squared, residuals.omega_n_squared],
        n_residuals=len(residuals.omega_n_squared),
        damping_ratio=damping_ratio,
        attachments=tuple(
            Attachment(a.name, a.position, a.motion(nodes) @ shapes) for a in attachments
        ),
        nodes=nodes,
        shapes=shapes.reshape(len(nodes), 6, -1).astype(np.float32),
        mesh=display,
    )
