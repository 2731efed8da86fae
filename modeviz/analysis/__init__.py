"""A vehicle made ready once, and its modes, ride and wheel loads at any mount rates."""
