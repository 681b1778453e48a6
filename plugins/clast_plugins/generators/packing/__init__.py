"""Random packings of spheres, shared by the generators of agglomerates."""
