"""The colours of marks that mean what they mark."""

from modeviz.shapes.colors import Color

RUBBER: Color = (236, 190, 96)
STEEL: Color = (60, 64, 70)
SELECTED: Color = (242, 140, 24)
"""Of a mount whose group is, and of what hangs on it."""
BLUE: Color = (43, 124, 196)
"""Of points and of the ground."""
