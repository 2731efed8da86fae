"""The tables of `vehicle.toml` and what each becomes.

A record is one table as it stands in the file, so its fields are the keys; each says what its numbers
are. `build` makes the vehicle's part from a record in SI, `of` the record from the part.
"""
