"""The built-in pickup truck: its geometry, its numbers, its look."""
