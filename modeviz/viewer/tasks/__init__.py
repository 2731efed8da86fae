"""Long work beside a session: searches, fronts, scatter, what one page asks for."""
