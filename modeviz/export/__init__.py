"""What was found, as files that other programs read: each format a module that writes bytes."""
