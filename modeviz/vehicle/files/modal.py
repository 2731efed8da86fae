"""The arrays of a flexible body as a file: what NumPy calls .npz, the same bytes every time."""

import zipfile
from io import BytesIO
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.vehicle.bodies import Attachment, FlexibleBody, Mesh, Role
from modeviz.vehicle.files.disk import read_bytes

KINDS = {
    "omega_n_squared": ("f", 1),
    "n_residuals": ("i", 0),
    "attachment_names": ("U", 1),
    "attachment_positions": ("f", 2),
    "attachment_shapes": ("f", 3),
    "nodes": ("f", 2),
    "shapes": ("f", 3),
}
"""The arrays of a body: what is in each, as `dtype.kind` has it, and how many dimensions it has."""

KIND_NAMES = {"f": "real numbers", "i": "whole numbers", "U": "text"}


def read_flexible_body(
    path: Path, name: str, role: Role, label: str, damping_ratio: float, mesh: Mesh
) -> FlexibleBody:
    """The body whose arrays are in the file.

    Raises:
        VehicleError: no such file, a damaged one, or arrays that are missing, pickled or not a body's.
    """
    arrays = _read_arrays(path)
    names, positions, shapes = (
        arrays[f"attachment_{what}"] for what in ("names", "positions", "shapes")
    )
    if not len(names) == len(positions) == len(shapes):
        raise VehicleError(
            f"{path}: attachment_names, attachment_positions and attachment_shapes: found shapes "
            f"{names.shape}, {positions.shape} and {shapes.shape}, expected one row for each attachment"
        )
    with located(path):
        return FlexibleBody(
            name,
            role,
            label,
            arrays["omega_n_squared"],
            int(arrays["n_residuals"]),
            damping_ratio,
            tuple(map(Attachment, names.tolist(), positions, shapes)),
            arrays["nodes"],
            arrays["shapes"],
            mesh,
        )


def write_flexible_body(path: Path, body: FlexibleBody) -> None:
    """Writes the arrays of the body; the file depends on them alone, not on the day."""
    attachments = body.attachments
    _write_arrays(
        path,
        {
            "omega_n_squared": body.omega_n_squared,
            "n_residuals": np.array(body.n_residuals),
            "attachment_names": np.array([a.name for a in attachments], np.str_),
            "attachment_positions": np.array([a.position for a in attachments]).reshape(-1, 3),
            "attachment_shapes": np.array([a.shapes for a in attachments]).reshape(-1, 6, body.n_modes),
            "nodes": body.nodes,
            "shapes": body.shapes,
        },
    )


def _read_arrays(path: Path) -> dict[str, np.ndarray]:
    content = read_bytes(path)
    try:
        with zipfile.ZipFile(BytesIO(content)) as archive:
            names = [name.removesuffix(".npy") for name in archive.namelist()]
            _check_names(names)
            arrays = {name: _read_array(archive, name) for name in KINDS}
    except VehicleError as error:
        raise VehicleError(f"{path}: {error}") from None
    except Exception as error:  # damaged archives make zipfile and NumPy raise almost anything
        raise VehicleError(f"{path}: not a whole .npz file ({error})") from None
    return arrays


def _check_names(names: list[str]) -> None:
    for name in KINDS:
        if name not in names:
            raise VehicleError(f"{name}: missing; there are {', '.join(names)}")


def _read_array(archive: zipfile.ZipFile, name: str) -> np.ndarray:
    try:
        with archive.open(f"{name}.npy") as file:
            array = np.lib.format.read_array(file, allow_pickle=False)
    except ValueError as error:
        raise VehicleError(f"{name}: {error}") from None
    if (array.dtype.kind, array.ndim) != KINDS[name]:
        kind, n_dimensions = KINDS[name]
        raise VehicleError(
            f"{name}: found {array.dtype} in {array.ndim} dimensions, expected {KIND_NAMES[kind]} in "
            f"{n_dimensions}"
        )
    return array


def _write_arrays(path: Path, arrays: dict[str, np.ndarray]) -> None:
    with zipfile.ZipFile(path, "w") as archive:
        for name, array in arrays.items():
            content = BytesIO()
            np.lib.format.write_array(content, np.array(array, order="C"), allow_pickle=False)
            archive.writestr(zipfile.ZipInfo(f"{name}.npy"), content.getvalue())
