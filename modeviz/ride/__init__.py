"""Road and wheel responses and their rating."""
