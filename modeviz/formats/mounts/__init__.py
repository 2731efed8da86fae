"""Mounts from other programs, each file as `Bushing`s: what springs and dampers join.

Tables are read by `files.mount_tables`, which a vehicle folder's own are read by too. Property files of
bushings are read by a parser of their own: no package reads them.
"""
