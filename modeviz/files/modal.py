"""The arrays of a flexible body as a file: what NumPy calls .npz, the same bytes every time."""

import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from modeviz.errors import VehicleError, listed, located, reason
from modeviz.files.disk import opened
from modeviz.files.schema.conventions import Conventions
from modeviz.files.source import LARGEST_ARRAYS, Source
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Attachment, FlexibleBody


def _places(array: np.ndarray, conventions: Conventions) -> np.ndarray:
    """Places in SI and our axes; those of a wrong shape as they are, since no body has them."""
    return conventions.positions(array) if array.shape[-1] == 3 else array


def _shapes(array: np.ndarray, conventions: Conventions) -> np.ndarray:
    """Shapes in SI and our axes; those of a wrong shape as they are."""
    return conventions.shapes(array) if array.shape[-2] in (3, 6) else array


@dataclass(frozen=True)
class ArrayKind:
    """The kind of an array of the file."""

    kind: str
    """As `dtype.kind` has it."""
    n_dimensions: int
    converted: Callable[[np.ndarray, Conventions], np.ndarray] | None = None
    """Into SI and our axes; None for what is the same in all."""


ARRAYS = {
    "omega_n_squared": ArrayKind("f", 1),  # rad²/s²
    "n_residuals": ArrayKind("i", 0),
    "attachment_names": ArrayKind("U", 1),
    "attachment_positions": ArrayKind("f", 2, _places),
    "attachment_shapes": ArrayKind("f", 3, _shapes),
    "nodes": ArrayKind("f", 2, _places),
    "shapes": ArrayKind("f", 3, _shapes),
}
"""The arrays of a body."""

NEAR_ZERO_HZ, NEAR_ZERO = 0.05, 0.01
"""Of a free body's first modes, what is below this, or this part of the first elastic one, is rigid."""

KIND_NAMES = {"f": "real numbers", "i": "whole numbers", "U": "text"}


def read_flexible_body(
    path: Path,
    name: str,
    properties: Mapping[str, Any],
    source: Source,
) -> FlexibleBody:
    """The body whose arrays are in the file.

    Frequencies near zero, as solvers give them, are zero. Rotations that are left out, as by solid
    elements and tests in three directions, are those of the rigid modes, and none of the others.

    Args:
        path: of the file.
        name: of the body.
        properties: what else it takes to make a `FlexibleBody`.
        source: the folder it is in, with the units and the axes of its arrays.

    Raises:
        VehicleError: no such file, a damaged one, or arrays that are missing, pickled or not a body's.
    """
    arrays = {
        name: convert(array, source.conventions) if (convert := ARRAYS[name].converted) else array
        for name, array in _read_arrays(path, source).items()
    }
    names, positions, shapes = (
        arrays[f"attachment_{what}"] for what in ("names", "positions", "shapes")
    )
    if not len(names) == len(positions) == len(shapes):
        raise VehicleError(
            f"{path}: attachment_names, attachment_positions and attachment_shapes: found shapes "
            f"{names.shape}, {positions.shape} and {shapes.shape}, expected one row for each attachment"
        )
    with located(path):
        body = FlexibleBody(
            name=name,
            omega_n_squared=_zeros_noted(arrays["omega_n_squared"], f"body {name!r}", source.note),
            n_residuals=int(arrays["n_residuals"]),
            attachments=tuple(map(Attachment, names.tolist(), positions, _with_six_rows(shapes))),
            nodes=arrays["nodes"],
            shapes=_with_six_rows(arrays["shapes"]),
            **properties,
        )
    return _turned(body, source.note)


def write_flexible_body(path: Path, body: FlexibleBody) -> None:
    """Writes the arrays of the body, see `arrays_file`."""
    path.write_bytes(arrays_file(body_arrays(body)))


def body_arrays(body: FlexibleBody) -> dict[str, np.ndarray]:
    """The arrays of the body by their names, see `ARRAYS`."""
    attachments = body.attachments
    return {
        "omega_n_squared": body.omega_n_squared,
        "n_residuals": np.array(body.n_residuals),
        "attachment_names": np.array([a.name for a in attachments], np.str_),
        "attachment_positions": np.array([a.position for a in attachments]).reshape(-1, 3),
        "attachment_shapes": np.array([a.shapes for a in attachments]).reshape(-1, 6, body.n_modes),
        "nodes": body.nodes,
        "shapes": body.shapes,
    }


def with_zeros(omega_n_squared: Floats) -> tuple[Floats, int]:
    """ω² with zeros for the rigid modes, and of how many it was near zero but not zero.

    Solvers give rigid modes 1e-4 Hz, or ω² a little below zero.
    """
    frequency_hz = np.sqrt(np.abs(omega_n_squared)) / (2 * np.pi)
    lowest_elastic = frequency_hz[FlexibleBody.N_RIGID : FlexibleBody.N_RIGID + 1]
    limit = max(NEAR_ZERO_HZ, NEAR_ZERO * float(lowest_elastic.max(initial=0.0)))
    rigid = frequency_hz[: FlexibleBody.N_RIGID]
    near = np.flatnonzero((rigid > 0) & (rigid < limit))
    result = omega_n_squared.copy()
    result[near] = 0
    return result, len(near)


def _zeros_noted(omega_n_squared: Floats, where: str, note: Callable[[str], None]) -> Floats:
    """The same, with a note if there were any."""
    result, n_near = with_zeros(omega_n_squared)
    if n_near:
        near = omega_n_squared[result != omega_n_squared]
        n_first = len(omega_n_squared[: FlexibleBody.N_RIGID])
        note(
            f"{where}: omega_n_squared: {n_near} of the first {n_first} modes are near zero, up to "
            f"{np.sqrt(np.abs(near).max()) / (2 * np.pi):.1g} Hz; taken for zero, as rigid modes"
        )
    return result


def _with_six_rows(shapes: np.ndarray) -> np.ndarray:
    """Motions of places, (n_places, 6, n_modes), with no rotations where the file has none."""
    if shapes.shape[1] != 3:
        return shapes
    return np.concatenate([shapes, np.zeros_like(shapes)], axis=1)


def _turned(body: FlexibleBody, note: Callable[[str], None]) -> FlexibleBody:
    """The body with rotations in its rigid modes where it has none in any mode."""
    turn = np.zeros((6, body.n_modes))
    turn[3:, : body.n_rigid] = body.rigid_fit.motions[3:]
    if body.attachments and not any(a.shapes[3:].any() for a in body.attachments):
        note(
            f"body {body.name!r}: its attachments have no rotations: taken to turn as the body does in "
            "its rigid modes, and not as it deforms"
        )
        attachments = tuple(replace(a, shapes=a.shapes + turn) for a in body.attachments)
        body = replace(body, attachments=attachments)
    if body.shapes[:, 3:].any():
        return body
    return replace(body, shapes=body.shapes + turn)


def _read_arrays(path: Path, source: Source) -> dict[str, np.ndarray]:
    with opened(path, LARGEST_ARRAYS) as file:
        try:
            with zipfile.ZipFile(file) as archive:
                members = [_member(archive, name) for name in ARRAYS]
                source.reserve(sum(member.file_size for member in members))
                arrays = {name: _read_array(archive, name) for name in ARRAYS}
        except VehicleError as error:
            raise VehicleError(f"{path}: {error}") from None
        except Exception as error:  # damaged archives make zipfile and NumPy raise almost anything
            raise VehicleError(f"{path}: not a whole .npz file ({reason(error)})") from None
    return arrays


def _member(archive: zipfile.ZipFile, name: str) -> zipfile.ZipInfo:
    """An array's place in the archive."""
    try:
        member = archive.getinfo(f"{name}.npy")
    except KeyError:
        names = [found.removesuffix(".npy") for found in archive.namelist()]
        raise VehicleError(f"{name}: missing; there are {listed(names)}") from None
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise VehicleError(f"{name}: compressed otherwise than numpy.savez_compressed does")
    return member


def _read_array(archive: zipfile.ZipFile, name: str) -> np.ndarray:
    try:
        with archive.open(f"{name}.npy") as file:
            array = np.lib.format.read_array(file, allow_pickle=False)
    except ValueError as error:
        raise VehicleError(f"{name}: {error}") from None
    expected = ARRAYS[name]
    if (array.dtype.kind, array.ndim) != (expected.kind, expected.n_dimensions):
        raise VehicleError(
            f"{name}: found {array.dtype} in {array.ndim} dimensions, expected "
            f"{KIND_NAMES[expected.kind]} in {expected.n_dimensions}"
        )
    return array


def arrays_file(arrays: Mapping[str, np.ndarray]) -> bytes:
    """The content of an .npz file of arrays by their names; it depends on nothing else."""
    content = BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        for name, array in arrays.items():
            member = BytesIO()
            np.lib.format.write_array(member, np.array(array, order="C"), allow_pickle=False)
            archive.writestr(zipfile.ZipInfo(f"{name}.npy"), member.getvalue())
    return content.getvalue()
