"""What a server holds: vehicles on their benches and the sessions on them, opened as people come."""
