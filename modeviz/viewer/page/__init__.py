"""The browser's page: who gets in, what is said both ways, and what viser lacks."""
