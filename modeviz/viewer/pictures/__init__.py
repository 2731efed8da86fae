"""Pictures of the 3-D view, on a page that someone looks at or on none."""
