"""The vehicle as data."""
