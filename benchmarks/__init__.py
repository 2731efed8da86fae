"""How fast modeviz is, beside others that do the same work: `python -m benchmarks`."""
