"""The page an engineer tunes mounts on."""
