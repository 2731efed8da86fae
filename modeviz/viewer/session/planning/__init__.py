"""What somebody on the page wants optimised, and the problem that comes of it."""
