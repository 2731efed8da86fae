"""Vehicles whose parts scatter: tolerances, samples, the worst case, robust goals."""
