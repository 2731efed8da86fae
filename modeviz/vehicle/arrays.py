"""Checked, read-only arrays for the frozen values of a vehicle."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from modeviz.errors import VehicleError, kind_of, quoted

Array = NDArray[Any]
"""Of numbers of any kind."""

Floats = NDArray[np.float64]
Complexes = NDArray[np.complexfloating]

FARTHEST = 1e6
"""m: no vehicle reaches so far from its origin, and pictures, in single precision, do not either."""


def frozen(
    owner: Any, field: str, value: ArrayLike, shape: tuple[int | None, ...], dtype: Any = np.float64
) -> None:
    """Stores `value` in a frozen dataclass as a read-only array of the given shape.

    Args:
        owner: the dataclass being made.
        field: which of its fields to set.
        value: what it was given.
        shape: the lengths expected, None where any will do.
        dtype: of the stored array.

    Raises:
        VehicleError: wrong number of dimensions or length, or a value that is not finite.
    """
    what = _named(owner, field)
    try:
        array = np.array(value, dtype)
    except (TypeError, ValueError):
        raise VehicleError(f"{what}: found {quoted(value)}, expected an array of numbers") from None
    wrong = array.ndim != len(shape) or any(
        n is not None and n != m for n, m in zip(shape, array.shape, strict=False)
    )
    if wrong:
        wanted = " x ".join("any" if n is None else str(n) for n in shape)
        raise VehicleError(f"{what}: found shape {array.shape}, expected {wanted}")
    if not np.isfinite(array).all():
        raise VehicleError(f"{what}: found {np.sum(~np.isfinite(array))} values that are not finite")
    array.flags.writeable = False
    object.__setattr__(owner, field, array)


def frozen_places(owner: Any, field: str, value: ArrayLike, shape: tuple[int | None, ...]) -> None:
    """Stores coordinates of places, m, as `frozen` does.

    Raises:
        VehicleError: as `frozen`, or a place beyond `FARTHEST`.
    """
    frozen(owner, field, value, shape)
    farthest = float(np.abs(getattr(owner, field)).max(initial=0.0))
    if farthest > FARTHEST:
        what = _named(owner, field)
        raise VehicleError(f"{what}: found {farthest:.3g} m, expected places within {FARTHEST:g} m")


def _named(owner: Any, field: str) -> str:
    name = getattr(owner, "name", None)
    return f"{kind_of(owner)}{'' if name is None else f' {name!r}'}: {field}"
