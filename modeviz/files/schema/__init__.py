"""How plain data becomes records: what a field may hold, its units and axes, and how errors read."""
