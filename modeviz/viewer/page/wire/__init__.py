"""What goes between pages and server: requests, connections, messages, and how much of each may."""
