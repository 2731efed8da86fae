"""Modes and phase to displaced, coloured geometry."""
