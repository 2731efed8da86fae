"""Mount rates searched for: designs, goals, limits, and the ways to the best."""
