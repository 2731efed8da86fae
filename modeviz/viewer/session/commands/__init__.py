"""What can be asked of a tuning session: each command makes a state of the present one."""
