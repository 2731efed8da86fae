"""Who gets in, by which link, and what the page is that they get."""
