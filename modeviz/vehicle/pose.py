"""Where a component stands in the vehicle: how it is turned and moved out of its own coordinates."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Floats, frozen, frozen_places
from modeviz.vehicle.bodies import Attachment, FlexibleBody, MeshPart

SQUARE = 1e-3
"""Axes may be off right angles by so much, in radians; they are made square."""

COLLINEAR = 1e-3
"""Three points tell a turn if one is off the line of the others by this part of their distance."""

APART = 2e-3
"""Of how far points lie apart in the component: by so much it may be otherwise in the vehicle."""


@dataclass(frozen=True, eq=False)
class Pose:
    """Takes places of a component to the vehicle, x ↦ R x + t."""

    rotation: Floats
    """R (3, 3): columns are the component's axes in the vehicle."""
    origin: Floats
    """t (3,), m: where the component's origin is in the vehicle."""
    misfit: float = 0.0
    """m: how far the points that tell it are from their places at most."""

    def __post_init__(self) -> None:
        frozen(self, "rotation", self.rotation, (3, 3))
        frozen_places(self, "origin", self.origin, (3,))
        R = self.rotation
        if not np.allclose(R.T @ R, np.eye(3), atol=1e-9):
            raise VehicleError("pose: rotation: expected three axes of length one at right angles")
        if np.linalg.det(R) < 0:
            raise VehicleError("pose: rotation: found left-handed axes, expected right-handed ones")

    @classmethod
    def from_axes(
        cls, x: ArrayLike, y: ArrayLike, z: ArrayLike | None = None, origin: ArrayLike = (0, 0, 0)
    ) -> "Pose":
        """Return the pose of a component whose axes point along some directions of the vehicle.

        Args:
            x: (3,), where its x axis points, of any length.
            y: (3,), where its y axis points.
            z: (3,), where its z axis points; if not given, as x and y ask.
            origin: (3,), m, where its origin is.

        Raises:
            VehicleError: they are not at right angles, or left-handed.
        """
        given = [np.asarray(axis, float) for axis in (x, y, z) if axis is not None]
        lengths = [np.linalg.norm(axis) for axis in given]
        if not all(np.isfinite(length) and length > 0 for length in lengths):
            raise VehicleError("axes: found one without a direction")
        axes = [axis / length for axis, length in zip(given, lengths, strict=True)]
        if z is None:
            axes.append(np.cross(axes[0], axes[1]))
        R = np.column_stack(axes)
        off = np.abs(R.T @ R - np.eye(3)).max()
        if off > SQUARE:
            raise VehicleError(
                f"axes: found {np.degrees(np.arcsin(min(off, 1.0))):.3g}° off right angles, expected "
                "axes at right angles"
            )
        if np.linalg.det(R) < 0:
            raise VehicleError("axes: found left-handed ones, expected z along x × y")
        return cls(_nearest_rotation(R), np.asarray(origin, float))

    @classmethod
    def from_points(cls, points: ArrayLike, places: ArrayLike) -> "Pose":
        """Return the pose that takes points of a component to places in the vehicle, by least squares.

        Args:
            points: (n_points, 3), m, in the component; three or more.
            places: (n_points, 3), m, where they are in the vehicle.

        Raises:
            VehicleError: they are too few, on a line, or lie otherwise in the vehicle than in the
                component, as of other units or of a mirrored one.
        """
        here, there = np.asarray(points, float), np.asarray(places, float)
        if here.ndim != 2 or len(here) < 3 or here.shape != there.shape or here.shape[1] != 3:
            raise VehicleError(
                f"found {len(here)} points and {len(there)} places, expected three or more of each"
            )
        if not (np.isfinite(here).all() and np.isfinite(there).all()):
            raise VehicleError("found points or places that are no finite numbers")
        centers = here.mean(axis=0), there.mean(axis=0)
        a, b = here - centers[0], there - centers[1]
        for what, given in (("points", a), ("places", b)):
            sizes = np.linalg.svd(given, compute_uv=False)
            if not sizes[1] > COLLINEAR * sizes[0]:
                raise VehicleError(
                    f"the {what} lie on a line, so they tell no turn about it; expected three that "
                    "span a plane"
                )
        _check_alike(a, b)
        R = _nearest_rotation(b.T @ a)
        pose = cls(R, centers[1] - R @ centers[0])
        off = np.linalg.norm(pose.places(here) - there, axis=1)
        if off.max() > APART * np.linalg.norm(a, axis=1).max():
            raise VehicleError(
                f"no turn takes the points to their places: point {off.argmax() + 1} is "
                f"{off.max():.3g} m off; is one side mirrored?"
            )
        return replace(pose, misfit=float(off.max()))

    def places(self, positions: ArrayLike) -> Floats:
        """Return where places of the component are in the vehicle, (..., 3), m."""
        return np.asarray(positions, float) @ self.rotation.T + self.origin

    def moved(self, body: FlexibleBody) -> FlexibleBody:
        """Return a body in the vehicle that is in the component's coordinates."""
        mesh = tuple(_moved_part(part, self) for part in body.mesh)
        return replace(
            body,
            attachments=tuple(
                Attachment(a.name, self.places(a.position), self._turned(a.shapes))
                for a in body.attachments
            ),
            nodes=self.places(body.nodes),
            shapes=self._turned(body.shapes),
            mesh=mesh,
        )

    def _turned(self, shapes: np.ndarray) -> np.ndarray:
        """Motions and rotations (..., 6, n_modes) along the vehicle's axes."""
        R = self.rotation.astype(shapes.dtype)
        return np.concatenate([R @ shapes[..., :3, :], R @ shapes[..., 3:, :]], axis=-2)


def _moved_part(part: MeshPart, pose: Pose) -> MeshPart:
    return replace(part, vertices=pose.places(part.vertices))


def _nearest_rotation(A: Floats) -> Floats:
    """The rotation R with the largest tr(Rᵀ A), (3, 3) (W. Kabsch, 1976)."""
    u, _, vt = np.linalg.svd(A)
    return u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))]) @ vt


def _check_alike(a: Floats, b: Floats) -> None:
    """Raises VehicleError unless points lie apart alike; a factor of units is told."""
    apart, there = (np.linalg.norm(p[:, None] - p[None], axis=2) for p in (a, b))
    i, j = np.unravel_index(np.abs(there - apart).argmax(), apart.shape)
    if abs(there[i, j] - apart[i, j]) <= APART * apart.max():
        return
    ratio = float(np.sqrt(np.sum(there**2) / np.sum(apart**2)))
    alike = np.allclose(there, ratio * apart, atol=APART * there.max())
    hint = f", as all are {ratio:.5g} times as far apart: are they in other units?" if alike else ""
    raise VehicleError(
        f"points {i + 1} and {j + 1} are {apart[i, j]:.5g} m apart in the component and "
        f"{there[i, j]:.5g} m in the vehicle{hint}"
    )
