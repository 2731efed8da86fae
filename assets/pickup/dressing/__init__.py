"""How the truck looks: each body's sheet metal, and what is set on it."""
