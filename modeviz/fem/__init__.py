"""Shell and beam meshes to modal bodies."""
