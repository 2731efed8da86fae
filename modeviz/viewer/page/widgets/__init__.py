"""What viser lacks in widgets, and how they look: cheap updates, notices, texts, keys, scripts."""
