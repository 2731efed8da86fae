"""The tables of `vehicle.toml`: a record is one table, its fields are the keys."""
