"""Neighbour searches, one per file."""
