"""The arrays of a binary glTF file: accessors, strided, normalised and sparse."""

import numpy as np

from modeviz.errors import VehicleError
from modeviz.files.mesh_formats.glb_document import Glb, item
from modeviz.files.mesh_formats.glb_records import Accessor, Sparse
from modeviz.files.mesh_formats.limits import MOST_POINTS, check_size
from modeviz.vehicle.arrays import Array

DTYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

MOST_NUMBERS = 3 * MOST_POINTS
"""Rows of an accessor: the corners of as many faces as are read."""


def values(glb: Glb, index: int, *types: str) -> Array:
    """The values of an accessor as they are stored, (count, width).

    Args:
        glb: the file.
        index: of the accessor.
        *types: what it may be, such as "VEC3".

    Raises:
        VehicleError: there is no such accessor, it is of another type, too long, or not all there.
    """
    accessor = item(glb.document.accessors, index, "accessors")
    if accessor.type not in types:
        raise VehicleError(f"accessors[{index}]: found {accessor.type}, expected {' or '.join(types)}")
    check_size(f"rows in accessors[{index}]", accessor.count, MOST_NUMBERS)
    dtype, width = np.dtype(DTYPES[accessor.component_type]), WIDTHS[accessor.type]
    if accessor.buffer_view is not None:
        stored = _rows(
            glb, accessor.buffer_view, accessor.byte_offset, (accessor.count, width), dtype, index
        )
    elif accessor.sparse is not None:
        stored = np.zeros((accessor.count, width), dtype)
    else:
        raise VehicleError(f"accessors[{index}]: has no bytes: there is neither bufferView nor sparse")
    return stored if accessor.sparse is None else _replaced(glb, stored, accessor.sparse, index)


def scaled(stored: Array, accessor: Accessor) -> Array:
    """Values of an accessor as numbers: normalised integers stand for 0 to 1, or -1 to 1.

    glTF 2.0 specification, section 3.6.2.2, and KHR_mesh_quantization.
    """
    numbers = stored.astype(float)
    if not accessor.normalized or stored.dtype.kind == "f":
        return numbers
    return np.maximum(numbers / np.iinfo(stored.dtype).max, -1.0)


def _rows(
    glb: Glb, view: int, offset: int, shape: tuple[int, int], dtype: np.dtype, index: int
) -> Array:
    """Rows of a buffer view, without a copy; `index` is that of the accessor they are for."""
    content, (n_rows, width) = glb.view(view), shape
    stride = glb.document.buffer_views[view].byte_stride or width * dtype.itemsize
    end = offset + (n_rows - 1) * stride + width * dtype.itemsize
    if end > len(content):
        raise VehicleError(
            f"accessors[{index}]: ends at byte {end} of the {len(content)} in bufferViews[{view}]"
        )
    return np.ndarray(shape, dtype, content, offset, (stride, dtype.itemsize))


def _replaced(glb: Glb, stored: Array, sparse: Sparse, index: int) -> Array:
    """The rows of an accessor with those that are given one by one."""
    check_size(f"sparse rows in accessors[{index}]", sparse.count, MOST_NUMBERS)
    chosen, given = sparse.indices, sparse.values
    places = _rows(
        glb,
        chosen.buffer_view,
        chosen.byte_offset,
        (sparse.count, 1),
        np.dtype(DTYPES[chosen.component_type]),
        index,
    )[:, 0]
    if places.max() >= len(stored):
        raise VehicleError(f"accessors[{index}]: replaces row {places.max()} of {len(stored)}")
    new = stored.copy()
    new[places] = _rows(
        glb, given.buffer_view, given.byte_offset, (sparse.count, stored.shape[1]), stored.dtype, index
    )
    return new
