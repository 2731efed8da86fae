"""A vehicle folder's table of rigid bodies, a line each: its columns, and what a line says."""
