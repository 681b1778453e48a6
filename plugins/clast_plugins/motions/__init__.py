"""Motions of walls, one per file."""
