"""Plain data turned into records: the types, units and axes of fields, and how errors read."""
