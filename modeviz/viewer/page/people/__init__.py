"""Who looks at a session, who of them is in control, and what the others may do."""
