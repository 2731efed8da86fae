"""States of a session as text and back, whoever wrote the text."""
