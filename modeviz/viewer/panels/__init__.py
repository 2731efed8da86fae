"""The panels around the truck: what an engineer changes on the left, what it does on the right."""
