"""Filling a container with grains: how many, how large, poured as spheres, settled as rigid agglomerates."""
