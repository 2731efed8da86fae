"""Left column: the review of a session, and who is there."""
