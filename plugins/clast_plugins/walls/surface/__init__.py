"""Surfaces of triangles: reading them, finding the nearest point of one, and a tree around many."""
