"""What is shown and why: states, answers and plans, without a page."""
