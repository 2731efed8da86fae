"""The page of bodies alone: their meshes, own modes and attachments, a vehicle or not yet one."""
