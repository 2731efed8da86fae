"""How numbers, names and axes are written, wherever they are shown."""
