"""The study on disk: a vehicle's sessions with their changes, variants, notes, runs and pictures."""
