"""Which panels a tuning page has, where they stand, and what brings them after an answer."""
