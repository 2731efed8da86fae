"""Results as records, tables, charts, images and a page to print."""
