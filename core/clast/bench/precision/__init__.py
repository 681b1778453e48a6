"""Error against run time: problems, what is varied in them, and the orders of their errors."""
