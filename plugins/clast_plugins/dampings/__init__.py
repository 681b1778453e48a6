"""Dampings, one per file."""
