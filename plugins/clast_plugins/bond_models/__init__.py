"""Bond models, one per file."""
