"""Matrices, modes and frequency responses of a vehicle."""
