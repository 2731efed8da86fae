"""Rings around what they mark."""

import numpy as np


def ring(along_x: float, along_y: float) -> np.ndarray:
    """Return a closed ellipse as line segments, (48, 2, 3)."""
    angle = np.linspace(0, 2 * np.pi, 49)
    points = np.stack([along_x * np.cos(angle), along_y * np.sin(angle), 0 * angle], axis=1)
    return np.stack([points[:-1], points[1:]], axis=1).astype(np.float32)
