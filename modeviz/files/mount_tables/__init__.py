"""Tables of mounts, a line each: their columns, and what a line says.

A vehicle folder's own table and those that `modeviz import` takes have the same columns and are read
here; what is in them are `Bushing`s, which become the tables of `vehicle.toml`.
"""
