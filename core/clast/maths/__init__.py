"""Vectors, rotations and random numbers."""
