"""Rolling resistances, one per file."""
