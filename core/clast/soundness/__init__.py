"""Whether the numbers of a running scene can be trusted."""
