"""Random packings of equal spheres, shared by the generators of agglomerates."""
