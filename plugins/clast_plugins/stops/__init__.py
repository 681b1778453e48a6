"""Conditions that end a run, one per file."""
