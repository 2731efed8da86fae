"""Left column: the mount groups, their rates, and what changing one does."""
