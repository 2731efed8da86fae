"""Writing of numbers, names and axes, wherever they are shown."""
