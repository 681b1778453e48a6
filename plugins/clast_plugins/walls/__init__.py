"""Walls, one per file."""
