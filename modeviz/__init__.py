"""A mode viewer and tuning bench for vehicle mounts."""
