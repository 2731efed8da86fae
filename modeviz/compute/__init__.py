"""Long work: cancelled, counted, run here or on a cluster; nothing of vehicles."""
