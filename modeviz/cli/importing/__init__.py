"""The command that puts components, mounts and roads of other programs into a vehicle folder."""
