"""Matrices, modes and frequency responses of a vehicle.

A line is a frequency at which responses are solved; what lies between lines is interpolated.
"""
