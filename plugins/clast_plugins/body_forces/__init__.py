"""Body forces, one per file."""
